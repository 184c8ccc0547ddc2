// The distance to the nearest occupied block counts blocks, by the largest component.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/automaton/state/grid.h"

namespace voxmelt::render {

// Returns the distance of each block. `occupied` is 1 or 0 for each block, x fastest. No distance is more
// than `most`, which is below 32.
std::vector<std::uint8_t> block_distances(const std::vector<std::uint8_t>& occupied,
                                          const state::Grid& blocks, int most);

}  // namespace voxmelt::render
