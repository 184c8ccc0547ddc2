// The inner loops of the density field. They are compiled once for each instruction set and chosen at run
// time; the bits are the same.
#pragma once

#include <cstddef>
#include <cstdint>

namespace voxmelt::render {

struct Blend;

// Cells of a block, [z][y][x]: `row` cells from one row to the next, `slice` from one slice to the next.
template <class T>
struct Block {
  T* cells;
  std::size_t row, slice;
};

// Filtered rows of eight cells, of which the first `count` are inside the grid.
struct ShownRow {
  const std::uint16_t *solid, *liquid, *heat, *obstacle;  // no obstacles: null
};

inline constexpr int kLanes = 8;  // cells that a loop takes at once

// Cells beyond those that are asked for are read only where a comment says so, because another thread may be
// writing them.
struct Loops {
  // One pass of the 3x3x3 binomial filter, rounded to nearest: x * y * z cells of `to` from two more along
  // each axis of `from`, which may be `to`. Rows of `to` are written up to the next multiple of kLanes, those
  // of `from` read up to kLanes further than x + 2. `sums`: room for (x + 2 + 2 kLanes) (y + 3) numbers.
  void (*low_pass)(Block<const std::uint16_t> from, Block<std::uint16_t> to, int x, int y, int z,
                   std::uint32_t* sums);

  // How much of the liquid's filter each cell gets, 0..256, from the liquid and what is solid around it (no
  // obstacles: null). Whole groups are written.
  void (*weights)(const std::uint16_t* liquid, const std::uint16_t* solid, const std::uint16_t* obstacle,
                  int count, std::uint16_t* weights);

  // to = ((256 - weight) solid + weight liquid) / 256, to nearest. Whole groups are read.
  void (*mix)(const std::uint16_t* solid, const std::uint16_t* liquid, const std::uint16_t* weights,
              int count, std::uint16_t* to);

  // The smallest and the largest of x * y * z cells, x at most 2 kLanes.
  void (*range)(Block<const std::uint16_t> from, int x, int y, int z, std::uint16_t* low,
                std::uint16_t* high);

  // Four cells of the pyramid's first level from `rows` (at most 4) rows of cells, of which `count` along x
  // are inside the grid. `emission`: see Pyramid::refresh.
  void (*shrink)(const ShownRow* from, int rows, int count, const float* emission, Blend* to);
};

// The loops, compiled for an architecture of xsimd (density_loops.h).
template <class Arch>
Loops loops_for();

const Loops& loops();  // the best that this processor can run

}  // namespace voxmelt::render
