// The inner loops fill bricks of levels and of matter (docs/picture/definition.md, sections 6 and 12). They
// are compiled once for each instruction set and chosen at run time. All give the same bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/instruction_set.h"

namespace voxmelt::render {

inline constexpr int kPlacesOfBrick = 11;  // along an axis
inline constexpr int kCellsOfBrick = 8;

// Describes a brick of 8 x 8 x 8 cells of the field, and where the cells around it lie. Cells outside the
// grid repeat the nearest cell inside.
struct BrickSource {
  static constexpr int kWide = kCellsOfBrick + 2;
  std::array<std::size_t, kWide> rows,
      slices;                     // offsets of cells; a row has at least 16 readable cells beyond
  int x, cells_x;                 // first cell of the brick; cells of the grid
  int count_x, count_y, count_z;  // cells inside the grid
};

// Points to the filtered shares of a field. Without obstacles `obstacle` is null. Without glow and without
// solids of several colours `heat` is.
struct MatterSource {
  const std::uint16_t *solid, *liquid, *heat, *obstacle;  // obstacle and heat may be null
  const std::uint16_t* carrier;  // what has the heat: the liquid, or the solid if the heat is its tone
  const std::uint8_t* heats;     // byte of the heat by its mean in what carries it, 0 .. 256
};

// Holds the levels and the words (liquid + 256 heat + 65536 obstacle) of such a brick. Cells outside the grid
// are air.
struct BrickCells {
  static constexpr std::size_t kCells = kCellsOfBrick * kCellsOfBrick * kCellsOfBrick;
  alignas(32) std::array<std::int16_t, kCells> levels;
  alignas(32) std::array<std::uint32_t, kCells> matter;
};

// Points to the eight bricks of 11 x 11 x 11 places that hold these cells, x fastest. A pointer is null if
// there is no such brick.
struct BrickTargets {
  std::array<std::int16_t*, 8> levels;
  std::array<std::uint32_t*, 8> matter;
};

// Holds numbers of the eight blocks of such a brick, x fastest. They are the largest level, and the largest
// difference between the levels of neighbours along each axis.
struct BlockRanges {
  std::array<std::int16_t, 8> most;
  std::array<std::uint16_t, 8> along_x, along_y, along_z;
};

struct BrickLoops {
  // Tells whether any word of matter is not 0.
  bool (*cells)(const std::uint16_t* intensity, const MatterSource& matter, const BrickSource& source,
                BrickCells& to);
  // Tells whether the first target holds the same levels and the same matter.
  bool (*same)(const BrickCells& cells, const BrickTargets& targets);
  void (*scatter)(const BrickCells& from, const BrickTargets& to, bool with_matter);
  // Reads levels up to 16 beyond the last.
  void (*ranges)(const std::int16_t* levels, BlockRanges& to);
};

// Returns the loops, compiled for an architecture of xsimd (brick_kernels.h).
template <class Arch>
BrickLoops brick_loops_for();

// Returns the loops for a processor whose best instruction set is this one.
const BrickLoops& brick_loops_of(cpu::InstructionSet widest);
const BrickLoops& brick_loops();  // the best that this processor can run

}  // namespace voxmelt::render
