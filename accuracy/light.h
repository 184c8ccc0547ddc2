#pragma once

#include "accuracy/case.h"

namespace voxmelt::accuracy {

Outcome measure_lit_plane(const Conditions&);
Outcome measure_lit_ball(const Conditions&);
Outcome measure_shadow_edge(const Conditions&);
Outcome measure_dark_steps(const Conditions&);

}  // namespace voxmelt::accuracy
