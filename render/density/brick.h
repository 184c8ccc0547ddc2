// Bricks of 8x8x8 cells: the unit in which the field is refiltered and in which rays skip empty space.
#pragma once

#include "kernel/state/grid.h"

namespace voxmelt::render {

inline constexpr int kBrickSide = 8;

// How many bricks a grid needs along each axis; the last ones may reach past the grid.
inline state::Grid brick_grid(const state::Grid& cells) {
  const auto bricks = [](int side) { return (side + kBrickSide - 1) / kBrickSide; };
  return {bricks(cells.x), bricks(cells.y), bricks(cells.z)};
}

}  // namespace voxmelt::render
