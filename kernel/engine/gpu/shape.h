// A state on a device lies in linear memory with a border around it (program/cells.cl).
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/automaton/state/grid.h"

namespace voxmelt::gpu {

// The same numbers stand in program/cells.cl.
inline constexpr int kBrickX = 32, kBrickY = 4, kBrickZ = 4;

struct Shape {
  explicit Shape(state::Grid size)
      : grid(size),
        row((static_cast<std::int64_t>(size.x) + 1 + 31) / 32 * 32),
        slice(row * (size.y + 1)),
        first(slice + row + 32),  // the neighbour across the corner has a place, too
        cells(first + slice * (size.z + 1) + row),
        bricks{(size.x + kBrickX - 1) / kBrickX + 2, (size.y + kBrickY - 1) / kBrickY + 2,
               (size.z + kBrickZ - 1) / kBrickZ + 2} {}

  std::size_t at(int x, int y, int z) const {
    return static_cast<std::size_t>(first + z * slice + y * row + x);
  }

  state::Grid grid;
  std::int64_t row, slice;  // cells to the next row, and to the next slice
  std::int64_t first;       // place of the cell (0, 0, 0)
  std::int64_t cells;       // with the border
  state::Grid bricks;       // with a border
};

}  // namespace voxmelt::gpu
