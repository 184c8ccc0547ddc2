#pragma once

#include "accuracy/case.h"

namespace voxmelt::accuracy {

Outcome measure_cavities(const Conditions&);

}  // namespace voxmelt::accuracy
