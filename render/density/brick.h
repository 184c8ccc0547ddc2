// A brick has 8x8x8 cells. The field is kept up to date by bricks, and rays skip empty space by bricks.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/state/changed_bricks.h"
#include "kernel/automaton/state/grid.h"

namespace voxmelt::render {

using state::brick_grid;
using state::kBrickSide;

// Bounds the cells of a brick, or of some bricks side by side, that are inside the grid, from low to high.
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

// Tells where in a brick something is. The planes across each axis that hold it have a bit each.
struct BrickPart {
  std::uint8_t x = 0, y = 0, z = 0;

  static constexpr BrickPart whole() { return {0xff, 0xff, 0xff}; }
  bool any() const { return x != 0; }
  void add(const BrickPart& other) {
    x = static_cast<std::uint8_t>(x | other.x);
    y = static_cast<std::uint8_t>(y | other.y);
    z = static_cast<std::uint8_t>(z | other.z);
  }
};

// Returns planes of the neighbour at `side` (-1, 0, 1) of a brick. They lie within `cells` of these planes in
// the brick itself.
inline std::uint8_t reached(std::uint8_t planes, int side, int cells) {
  unsigned wide = unsigned{planes} << kBrickSide;
  for (int i = 0; i < cells; ++i) wide |= wide << 1 | wide >> 1;
  return static_cast<std::uint8_t>(wide >> (side + 1) * kBrickSide);
}

// Calls visit(neighbour, the part of it) for the brick and its neighbours within `cells` of the part.
template <class Visit>
void for_reached(const state::Grid& bricks, const state::Grid& brick, const BrickPart& part, int cells,
                 const Visit& visit) {
  std::array<BrickPart, 3> to;  // indexed by side + 1
  for (int side = -1; side <= 1; ++side)
    to[side + 1] = {reached(part.x, side, cells), reached(part.y, side, cells), reached(part.z, side, cells)};
  for (std::size_t z = 0; z < 3; ++z)
    for (std::size_t y = 0; y < 3 && to[z].z != 0; ++y)
      for (std::size_t x = 0; x < 3 && to[y].y != 0; ++x) {
        const state::Grid near{brick.x + static_cast<int>(x) - 1, brick.y + static_cast<int>(y) - 1,
                               brick.z + static_cast<int>(z) - 1};
        if (to[x].x != 0 && bricks.contains(near.x, near.y, near.z))
          visit(near, BrickPart{to[x].x, to[y].y, to[z].z});
      }
}

}  // namespace voxmelt::render
