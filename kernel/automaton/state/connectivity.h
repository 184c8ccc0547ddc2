// Which solids still stand on something.
#pragma once

#include <cstdint>

#include "kernel/automaton/state/volume.h"

namespace voxmelt::state {

// Solid cells without a path of face-adjacent solid cells to an inert cell or to the grid's bottom.
std::int64_t count_detached(const Volume& volume);

}  // namespace voxmelt::state
