// The inner loops that fill bricks of levels and of matter (docs/picture/definition.md, sections 6 and 12).
// They are compiled once for each instruction set and chosen at run time; the bits are the same.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/instruction_set.h"

namespace voxmelt::render {

inline constexpr int kPlacesOfBrick = 11;  // along an axis
inline constexpr int kCellsOfBrick = 8;

// A brick of 8 x 8 x 8 cells of the field, and where the cells around it lie. Cells outside the grid repeat
// the nearest inside.
struct BrickSource {
  static constexpr int kWide = kCellsOfBrick + 2;
  std::array<std::size_t, kWide> rows,
      slices;                     // offsets of cells; a row has at least 16 readable cells beyond
  int x, cells_x;                 // the first cell; the grid's
  int count_x, count_y, count_z;  // cells inside the grid
};

struct MatterSource {
  const std::uint16_t *solid, *liquid, *heat, *obstacle;  // no obstacles: null; no glow: no heat
  const std::uint8_t* heats;                              // by the temperature, 0 .. 256
};

// Levels and words (liquid + 256 heat + 65536 obstacle) of such a brick; air outside the grid.
struct BrickCells {
  static constexpr std::size_t kCells = kCellsOfBrick * kCellsOfBrick * kCellsOfBrick;
  alignas(32) std::array<std::int16_t, kCells> levels;
  alignas(32) std::array<std::uint32_t, kCells> matter;
};

// Where to: the eight bricks of 11 x 11 x 11 places that hold these cells, x fastest; null where there is
// none.
struct BrickTargets {
  std::array<std::int16_t*, 8> levels;
  std::array<std::uint32_t*, 8> matter;
};

// Of the eight blocks of such a brick, x fastest: the largest level, and by how much those of neighbours
// differ at most, along each axis.
struct BlockRanges {
  std::array<std::int16_t, 8> most;
  std::array<std::uint16_t, 8> along_x, along_y, along_z;
};

struct BrickLoops {
  // Tells whether any word of matter is not 0.
  bool (*cells)(const std::uint16_t* intensity, const MatterSource& matter, const BrickSource& source,
                BrickCells& to);
  // Does the first target hold the same levels, and the same matter?
  bool (*same)(const BrickCells& cells, const BrickTargets& targets);
  void (*scatter)(const BrickCells& from, const BrickTargets& to, bool with_matter);
  // Levels are read up to 16 beyond the last.
  void (*ranges)(const std::int16_t* levels, BlockRanges& to);
};

// The loops, compiled for an architecture of xsimd (brick_kernels.h).
template <class Arch>
BrickLoops brick_loops_for();

// Those that a processor runs whose best instruction set is this one.
const BrickLoops& brick_loops_of(cpu::InstructionSet widest);
const BrickLoops& brick_loops();  // the best that this processor can run

}  // namespace voxmelt::render
