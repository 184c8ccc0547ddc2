// The order of the stream: z outermost, then blocks of P cells along x, then y (gravity) innermost. One token
// holds the P cells of one block at one height.
#pragma once

#include <cstdint>

#include "kernel/automaton/state/grid.h"

namespace voxmelt::hwmodel {

struct Shape {
  state::Grid grid;
  int lanes = 1;

  int blocks() const { return (grid.x + lanes - 1) / lanes; }             // along x
  std::int64_t column() const { return grid.y; }                          // tokens of a column of blocks
  std::int64_t plane() const { return std::int64_t{blocks()} * grid.y; }  // tokens from z to z + 1
  std::int64_t tokens() const { return plane() * grid.z; }
};

// Where a token of the stream lies; `x` is that of its lane 0.
struct Place {
  int x = 0, y = 0, z = 0;
  std::int64_t ordinal = 0;

  void next(const Shape& shape) {
    ++ordinal;
    if (++y < shape.grid.y) return;
    y = 0;
    x += shape.lanes;
    if (x < shape.grid.x) return;
    x = 0;
    ++z;
  }
};

inline Place place_of(const Shape& shape, std::int64_t ordinal) {
  const std::int64_t column = ordinal / shape.grid.y;
  return {static_cast<int>(column % shape.blocks()) * shape.lanes, static_cast<int>(ordinal % shape.grid.y),
          static_cast<int>(column / shape.blocks()), ordinal};
}

// Position of a cell in the stream. The cell with the smaller position leaves a stage first.
inline std::int64_t stream_order(const Shape& shape, int x, int y, int z) {
  return ((static_cast<std::int64_t>(z) * shape.blocks() + x / shape.lanes) * shape.grid.y + y) *
             shape.lanes +
         x % shape.lanes;
}

}  // namespace voxmelt::hwmodel
