// The host writes into the ray caster's registers and small memories before a picture. They hold everything
// that all rays share. Nothing of a ray is computed here.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hwmodel/caster/model/arithmetic.h"

namespace voxmelt::hwmodel::raycast {

// Only pixels in the window are drawn. By default it is the whole picture.
struct Window {
  std::int32_t left = 0, top = 0;
  std::int32_t right = 1 << 30, bottom = 1 << 30;  // the first ones beyond

  bool holds(std::int32_t x, std::int32_t y) const {
    return x >= left && y >= top && x < right && y < bottom;
  }
  // Says if a tile, or another box of pixels, has pixels in the window.
  bool meets(std::int32_t x, std::int32_t y, std::int32_t side) const {
    return x + side > left && y + side > top && x < right && y < bottom;
  }
  bool whole() const { return *this == Window{}; }
  friend bool operator==(const Window&, const Window&) = default;
};

// Holds the view of a camera (docs/picture/definition.md, section 3).
struct CameraRegisters {
  Vec eye, forward, wide, high, near_wide, near_high;
  std::int64_t near = 0;
  std::int32_t width = 0, height = 0;  // pixels
  int spacing = 2;                     // steps of 2^-spacing cells
  int halvings = 0;
};

struct Material {
  Rgb diffuse{}, mirror{}, highlight{};
  std::int32_t gloss = 0;
};

// Holds light and look (docs/picture/light.md, sections 1 and 2).
struct LookRegisters {
  Vec to_light, to_strip;
  Rgb lamp{}, from_below{}, from_above{}, background{};
  Material solid, liquid, obstacle;
  bool glow = false, obstacles = false;
  bool clear = false;   // docs/picture/translucent.md
  bool tinted = false;  // solids have the material of their tone
  Rgb losses{};
  std::int32_t frost = 0;
  std::int32_t lamp_low = 0, lamp_high = 0, strip_low = 0;
  std::array<std::uint16_t, 1026> highlight{}, dull_highlight{};
  std::array<std::uint32_t, 2049> surroundings{};
  std::array<Rgb, 256> glow_light{}, glow_crust{};
  std::array<Material, 256> tints{};
  std::vector<std::uint16_t> tone;  // by light 0 .. 12287
  std::vector<std::uint8_t> bytes;  // by light 0 .. 4096
};

// Blocks tell of the ground without its columns (ground_blocks.h).
inline constexpr int kFineBits = 22;    // bits of a position in a block of 4 x 4 cells
inline constexpr int kCoarseBits = 24;  // bits of a position in a block of 16 x 16 cells
inline constexpr int kBoundShift = 6;   // bounds are in 2^-6 cells, heights in 2^-12

// Holds bounds for all places of a block, 17 bits each.
struct GroundBlock {
  std::int32_t highest = 0;
  std::int32_t slope_x = 0, slope_z = 0;  // the largest differences of two columns side by side
  friend bool operator==(const GroundBlock&, const GroundBlock&) = default;
};
struct GroundBlocks {
  int x = 0, z = 0;               // fine blocks
  std::vector<GroundBlock> fine;  // x fastest
  std::vector<std::int32_t> coarse;

  int coarse_x() const { return (x + 3) / 4; }
  const GroundBlock& fine_at(Vec p) const { return fine[(p.z >> kFineBits) * x + (p.x >> kFineBits)]; }
  std::int64_t coarse_at(Vec p) const {
    return coarse[(p.z >> kCoarseBits) * coarse_x() + (p.x >> kCoarseBits)];
  }
};

// Holds the slab (docs/picture/ground.md). Heights and texels lie in memory.
struct GroundRegisters {
  bool any = false;
  std::int64_t highest = 0;  // 2^-12 cells
  GroundBlocks blocks;
  Rgb color{};
  bool textured = false;
  int fineness = 0;                                // q of docs/picture/ground.md, section 7
  std::vector<std::int32_t> bands;                 // the noise of bands, by quarters of a cell
  std::array<std::vector<std::int32_t>, 4> bends;  // at low x, high x, low z, high z
};

// Tells where the field is empty: a word of 16 bits for each block of 4 x 4 x 4 lower cells of the lattice. A
// block with matter has its slope bound, 1 .. 255, in the low byte. Any other has 256 + its distance in
// blocks.
struct SkipMap {
  int x = 0, y = 0, z = 0;  // blocks
  std::vector<std::uint16_t> words;
  Vec low, high;  // positions outside of this box are air

  std::uint16_t at(std::int64_t bx, std::int64_t by, std::int64_t bz) const {
    return words[(bz * y + by) * x + bx];
  }
};

struct Registers {
  Vec cells;  // cells of the grid
  CameraRegisters camera;
  LookRegisters look;
  GroundRegisters ground;
  SkipMap skip;
  Vec light_cells;
  int light_shift = 1;
};

}  // namespace voxmelt::hwmodel::raycast
