#pragma once

#include "accuracy/case.h"

namespace voxmelt::accuracy {

Outcome measure_round_disc(const Conditions&);
Outcome measure_round_ball(const Conditions&);
Outcome measure_straight_front(const Conditions&);

}  // namespace voxmelt::accuracy
