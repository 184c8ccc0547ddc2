// The inner loops of the light (docs/picture/light.md, sections 4 and 5). They are compiled once for each
// instruction set and chosen at run time; the bits are the same.
//
// Rows of bytes begin at multiples of kLightLanes bytes from each other, and may be read and written up to
// the next one.
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

// Some cells of the field that make up whole cells of light, but for those at the end of the grid.
struct LightBlock {
  int x, y, z;             // cells, at most kMost each
  std::size_t row, slice;  // cells from one to the next
  const std::uint16_t *intensity, *liquid, *heat;
  const std::uint16_t* emission;  // by the temperature, 0 .. 256
  int shift;
  std::size_t to_row, to_slice;  // bytes
  static constexpr int kMost = 128;
};

// One slice of a sweep from a side, from that before it. Rows `low` to `high` - 1 are computed.
struct SideSlice {
  int u, v, low, high;
  std::size_t row, row_step;                        // bytes: of a row; from one to the next
  const std::uint8_t *before, *density, *emission;  // of the slice before; openness: no emission
  std::uint8_t* to;
  std::uint8_t* changed;  // of each row: 1 if it is not what it was
  std::uint16_t* room;    // (v + 5) (row + kLightLanes)
};

// One slice of the lamp's sweep.
struct LampSlice {
  int u, v;
  std::size_t row, row_step;
  const std::uint8_t* density;
  std::uint8_t* to;
  std::uint8_t* changed;
  int part_u, part_v;
  // Rays: `rays` is that of (-1, -1), before the lattice; the window's first one is (at_u, at_v).
  std::uint16_t* rays;
  std::uint16_t* room;    // as large as the rays
  std::uint16_t* losses;  // (v + 2) rows of ray_row
  std::size_t ray_row;
  int count_u, count_v, at_u, at_v;
  int low_v, high_v;  // rows of rays that may be darker than 255 afterwards
};

struct LightLoops {
  // Bytes of density, without the ground's, and of emission.
  void (*density)(const LightBlock& block, std::uint8_t* to);
  void (*emission)(const LightBlock& block, std::uint8_t* to);
  void (*side)(const SideSlice& slice);
  void (*lamp)(const LampSlice& slice);
  // to[y][x] = from[x][y]: x * y bytes. Whole rows are written. `changed` as above, of rows of `to`.
  void (*transpose)(const std::uint8_t* from, std::size_t from_row, int x, int y, std::uint8_t* to,
                    std::size_t to_row, std::uint8_t* changed);
  // Eight bytes of each of `count` cells, of which `to` points at the first.
  void (*interleave)(const std::array<const std::uint8_t*, 8>& from, int count, std::uint8_t* to);
};

// The loops, compiled for an architecture of xsimd (light_sweeps.h).
template <class Arch>
LightLoops light_loops_for();

// Those that a processor runs whose best instruction set is this one.
const LightLoops& light_loops_of(cpu::InstructionSet widest);
const LightLoops& light_loops();  // the best that this processor can run

}  // namespace voxmelt::render
