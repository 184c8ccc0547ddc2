#pragma once

#include "accuracy/case.h"

namespace voxmelt::accuracy {

Outcome measure_melted_ball(const Conditions&);
Outcome measure_convergence_in_grid(const Conditions&);
Outcome measure_convergence_in_step(const Conditions&);

}  // namespace voxmelt::accuracy
