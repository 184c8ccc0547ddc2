// All phases. The files that compile them include this one, each with its own options.
#pragma once

#include "bench/baseline/excess.h"
#include "bench/baseline/gravity.h"
#include "bench/baseline/heat.h"
#include "bench/baseline/spread.h"
#include "bench/baseline/update.h"
