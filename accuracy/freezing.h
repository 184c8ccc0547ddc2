#pragma once

#include "accuracy/case.h"

namespace voxmelt::accuracy {

Outcome measure_freezing(const Conditions&);
Outcome measure_crust(const Conditions&);
Outcome measure_glow(const Conditions&);
Outcome measure_cooling_flow(const Conditions&);

}  // namespace voxmelt::accuracy
