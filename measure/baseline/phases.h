// This header includes all phases. The files that compile them include it, each with its own options.
#pragma once

#include "measure/baseline/excess.h"
#include "measure/baseline/gravity.h"
#include "measure/baseline/heat.h"
#include "measure/baseline/spread.h"
#include "measure/baseline/update.h"
