// The coverage of a cell by a shape is counted by 4 x 4 x 4 sample points per cell at (i + 1/2) / 4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/automaton/state/grid.h"
#include "kernel/scene/shape/shape.h"

namespace voxmelt::scene {

inline constexpr int kSamplesPerAxis = 4;
inline constexpr int kSamplesPerCell = 64;
inline constexpr int kLeastSolid = kSamplesPerCell / 16;  // samples that make a cell solid, or liquid
inline constexpr int kLeastInert = kSamplesPerCell / 2;

// Is the part of a grid that a box touches: cells low .. low + size - 1, x fastest.
struct Window {
  int x = 0, y = 0, z = 0;  // lowest cell
  state::Grid size;         // 0 along some axis if the box touches no cell

  std::size_t index(int cx, int cy, int cz) const { return size.index(cx - x, cy - y, cz - z); }
};

Window window_of(const Box& box, state::Grid grid);

struct Coverage {
  Window window;
  std::vector<std::uint8_t> samples;  // 0..64 per cell of the window
};

// Counts exactly for the sample points. Blocks of cells far from the surface are decided by one distance.
Coverage cover(const Shape& shape, state::Grid grid);

}  // namespace voxmelt::scene
