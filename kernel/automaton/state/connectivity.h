// The count of detached solids tells if parts of the model no longer stand on anything.
#pragma once

#include <cstdint>

#include "kernel/automaton/state/volume.h"

namespace voxmelt::state {

// Counts the solid cells without a path of face-adjacent solid cells to an inert cell or to the grid's
// bottom.
std::int64_t count_detached(const Volume& volume);

}  // namespace voxmelt::state
