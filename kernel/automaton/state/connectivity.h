// Solids are held, or they no longer stand on anything.
#pragma once

#include <cstdint>

#include "kernel/automaton/state/bit_plane.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::state {

// Finds the solid cells without a path of face-adjacent solid cells to an inert cell or to the grid's
// bottom.
BitPlane loose_solids(const Volume& volume);

inline std::int64_t count_detached(const Volume& volume) { return loose_solids(volume).count(); }

}  // namespace voxmelt::state
