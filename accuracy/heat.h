#pragma once

#include "accuracy/case.h"

namespace voxmelt::accuracy {

Outcome measure_heat_kernel(const Conditions&);
Outcome measure_slab(const Conditions&);
Outcome measure_stefan(const Conditions&);
Outcome measure_stefan_two_phase(const Conditions&);
Outcome measure_checkerboard(const Conditions&);

}  // namespace voxmelt::accuracy
