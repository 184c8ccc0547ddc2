// Bricks of 8x8x8 cells: the unit in which the field is refiltered and in which rays skip empty space.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "kernel/automaton/state/grid.h"

namespace voxmelt::render {

inline constexpr int kBrickSide = 8;

// How many bricks a grid needs along each axis; the last ones may reach past the grid.
inline state::Grid brick_grid(const state::Grid& cells) {
  const auto bricks = [](int side) { return (side + kBrickSide - 1) / kBrickSide; };
  return {bricks(cells.x), bricks(cells.y), bricks(cells.z)};
}

// The cells of a brick, or of some bricks side by side, that are inside the grid: from low to high.
struct CellBox {
  state::Grid low, high;
};
inline CellBox cells_of(const state::Grid& cells, const state::Grid& brick, int bricks = 1) {
  const state::Grid low{brick.x * kBrickSide, brick.y * kBrickSide, brick.z * kBrickSide};
  return {low,
          {std::min(low.x + bricks * kBrickSide, cells.x), std::min(low.y + kBrickSide, cells.y),
           std::min(low.z + kBrickSide, cells.z)}};
}

// Calls visit(index of the first cell in the grid, that cell, how many cells) for each row of the box.
template <class Visit>
void for_rows(const state::Grid& grid, const CellBox& box, const Visit& visit) {
  for (int z = box.low.z; z < box.high.z; ++z)
    for (int y = box.low.y; y < box.high.y; ++y)
      visit(grid.index(box.low.x, y, z), state::Grid{box.low.x, y, z}, box.high.x - box.low.x);
}

// A byte per brick, every bit a flag of its own.
using BrickFlags = std::vector<std::uint8_t>;

// Sets every flag also in the neighbouring bricks, including those over edges and corners.
BrickFlags widened(const state::Grid& bricks, BrickFlags flags);

}  // namespace voxmelt::render
