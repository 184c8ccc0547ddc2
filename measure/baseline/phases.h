// All phases. The files that compile them include this one, each with its own options.
#pragma once

#include "measure/baseline/excess.h"
#include "measure/baseline/gravity.h"
#include "measure/baseline/heat.h"
#include "measure/baseline/spread.h"
#include "measure/baseline/update.h"
