#pragma once

#include "accuracy/case.h"

namespace voxmelt::accuracy {

Outcome measure_tubes(const Conditions&);
Outcome measure_u_tube(const Conditions&);

}  // namespace voxmelt::accuracy
