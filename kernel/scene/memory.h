// A grid must fit into memory. This is checked before anything is allocated.
#pragma once

#include <cstdint>

#include "kernel/automaton/state/grid.h"
#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// Returns the bytes that a run of this grid needs even while nothing is in it: half a byte for each cell.
std::uint64_t needed_bytes(state::Grid grid);

// Throws ResourceError with the needed and the available bytes if the grid does not fit.
void check_memory(state::Grid grid, const Place& place);

}  // namespace voxmelt::scene
