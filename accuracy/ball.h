#pragma once

#include "accuracy/case.h"

namespace voxmelt::accuracy {

Outcome measure_ball_in_mould(const Conditions&);
Outcome measure_ball_in_oven(const Conditions&);

}  // namespace voxmelt::accuracy
