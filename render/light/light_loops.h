// The inner loops compute the light (docs/picture/light.md, sections 4 and 5). They are compiled once for
// each instruction set and chosen at run time. All give the same bits.
//
// Rows of bytes begin at multiples of kLightLanes bytes from each other. They may be read and written up to
// the next multiple.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/instruction_set.h"
#include "render/light/light_bytes.h"

namespace voxmelt::render {

inline constexpr int kLightLanes = 16;
inline constexpr int light_row(std::int64_t cells) {
  return static_cast<int>((cells + kLightLanes - 1) / kLightLanes * kLightLanes);
}

// Describes some cells of the field. They make up whole cells of light, except at the end of the grid.
struct LightBlock {
  int x, y, z;             // cells, at most kMost each
  std::size_t row, slice;  // cells from one row or slice to the next
  const std::uint16_t *intensity, *liquid, *heat;
  const std::uint16_t* emission;  // indexed by the temperature, 0 .. 256
  int shift;
  std::size_t to_row, to_slice;  // bytes
  static constexpr int kMost = 128;
};

// Describes one slice of a sweep from a side, which follows from the slice before. Rows `low` to `high` - 1
// are computed.
struct SideSlice {
  int u, v, low, high;
  std::size_t row, row_step;                        // bytes in a row; bytes to the next row
  const std::uint8_t *before, *density, *emission;  // in the slice before; openness has no emission
  std::uint8_t* to;
  std::uint8_t* changed;  // for each row, 1 if it has changed
  std::uint16_t* room;    // (v + 5) (row + kLightLanes)
};

// Describes one slice of the lamp's sweep.
struct LampSlice {
  int u, v;
  std::size_t row, row_step;
  const std::uint8_t* density;
  std::uint8_t* to;
  std::uint8_t* changed;
  int part_u, part_v;
  // `rays` points to the ray (-1, -1), before the lattice. The first ray of the window is (at_u, at_v).
  std::uint16_t* rays;
  std::uint16_t* room;    // room of the same size as the rays
  std::uint16_t* losses;  // (v + 2) rows of ray_row
  std::size_t ray_row;
  int count_u, count_v, at_u, at_v;
  int low_v, high_v;  // rows of rays that may be darker than 255 afterwards
};

struct LightLoops {
  // These compute bytes of density, without the ground's, and bytes of emission.
  void (*density)(const LightBlock& block, std::uint8_t* to);
  void (*emission)(const LightBlock& block, std::uint8_t* to);
  void (*side)(const SideSlice& slice);
  void (*lamp)(const LampSlice& slice);
  // Sets to[y][x] = from[x][y], for x * y bytes. Whole rows are written. `changed` tells of the rows of `to`,
  // as above.
  void (*transpose)(const std::uint8_t* from, std::size_t from_row, int x, int y, std::uint8_t* to,
                    std::size_t to_row, std::uint8_t* changed);
  // Writes eight bytes of each of `count` cells. `to` points at the first cell.
  void (*interleave)(const std::array<const std::uint8_t*, 8>& from, int count, std::uint8_t* to);
};

// Returns the loops, compiled for an architecture of xsimd (light_sweeps.h).
template <class Arch>
LightLoops light_loops_for();

// Returns the loops for a processor whose best instruction set is this one.
const LightLoops& light_loops_of(cpu::InstructionSet widest);
const LightLoops& light_loops();  // the best that this processor can run

}  // namespace voxmelt::render
