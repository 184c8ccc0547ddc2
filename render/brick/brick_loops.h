// The inner loops that fill bricks of levels and of matter (docs/picture.md, sections 6 and 12). They are compiled
// once for each instruction set and chosen at run time; the bits are the same.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace voxmelt::render {

inline constexpr int kPlacesOfBrick = 11;  // along an axis

// Where a brick lies in the field: of its places and one more at each end. Cells outside the grid repeat the nearest
// inside.
struct BrickSource {
  static constexpr int kWide = kPlacesOfBrick + 2;
  std::array<std::size_t, kWide> rows, slices;  // offsets of cells; a row has at least 16 readable cells beyond
  int x, cells_x;                               // of the first place; of the grid
  std::array<int, 3> low, high;                 // places inside the grid: low <= place < high
};

// The filtered intensities of a brick's places, before they become levels; a row has 16.
struct BrickPlaces {
  static constexpr std::size_t kRow = 16;
  alignas(32) std::array<std::uint16_t, kPlacesOfBrick * kPlacesOfBrick * kRow> cells;
};

// Of the eight blocks of a brick, x fastest: the largest filtered intensity, and by how much those of neighbours
// differ at most, along each axis.
struct BlockRanges {
  std::array<std::uint16_t, 8> most, along_x, along_y, along_z;
};

struct MatterSource {
  const std::uint16_t *solid, *liquid, *heat, *obstacle;  // no obstacles: null; no glow: no heat
  const std::uint8_t* heats;                              // by the temperature, 0 .. 256
};

struct BrickLoops {
  // Is there any intensity that the places depend on?
  bool (*any)(const std::uint16_t* intensity, const BrickSource& source);
  void (*places)(const std::uint16_t* intensity, const BrickSource& source, BrickPlaces& to);
  void (*ranges)(const BrickPlaces& places, BlockRanges& to);
  // 11 x 11 x 11 levels.
  void (*levels)(const BrickPlaces& places, std::int16_t* to);
  // 11 x 11 x 11 words of liquid + 256 heat + 65536 obstacle, 0 where there is no intensity.
  void (*matter)(const MatterSource& matter, const BrickSource& source, const BrickPlaces& places, std::uint32_t* to);
};

// The loops, compiled for an architecture of xsimd (brick_kernels.h).
template <class Arch>
BrickLoops brick_loops_for();

const BrickLoops& brick_loops();  // the best that this processor can run

}  // namespace voxmelt::render
