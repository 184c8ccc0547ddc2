// The function here tells how large solid cells look from a point.
#pragma once

#include <array>

#include "kernel/automaton/state/volume.h"

namespace voxmelt::accuracy {

// Returns the solid angle that the solid cells cover, seen from `eye` outside the grid. It counts pixels of
// 1/8 cell on the plane that goes through the middle of the grid and faces the eye.
double solid_angle(const state::Volume& volume, const std::array<double, 3>& eye);

}  // namespace voxmelt::accuracy
