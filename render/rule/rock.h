// The ground's colour, and the roughness of rock (docs/picture-ground.md, sections 6 and 7).
//
// A colour is linear red, green and blue; kColor is 1.
#pragma once

#include <algorithm>
#include <cstdint>

#include "render/rule/fixed_point.h"
#include "render/rule/heights.h"
#include "render/rule/noise.h"
#include "render/rule/normal.h"
#include "render/rule/sample.h"

namespace voxmelt::picture {

inline constexpr int kColorBits = 12;
inline constexpr std::int32_t kColor = 1 << kColorBits;

// Texels lie 2^fineness to a cell. Positions in texels then fit the width of positions in cells.
VOXMELT_RULE int texel_fineness(Vector cells) {
  const std::int64_t side = std::max(cells.x, cells.z);
  return side <= 256 ? 2 : side <= 512 ? 1 : 0;
}

// The rock at a place of the top: its colour, and what its relief adds to the normal, in 1 / kBump.
struct Texel {
  std::uint16_t red = 0, green = 0, blue = 0;
  std::int8_t bump_x = 0, bump_z = 0;
};
inline constexpr int kBumpBits = 8;

// Numbers of noises; each octave takes one more.
inline constexpr std::uint32_t kPatches = 0, kGrain = 16, kRelief = 32, kBand = 48, kBend = 64;

// `elevation` is 0 .. kHeight from the lowest column to the highest, `up` the y of the normal.
VOXMELT_RULE Vector rock_color(Vector base, std::int64_t elevation, std::int64_t up, std::int64_t patches,
                               std::int64_t grain) {
  const std::int64_t pale = smooth_step(410, 3686, elevation + (patches * 51 >> 8));
  const std::int64_t steep =
      3 * smooth_step(492, 2048, kHeight - (up >> (kNormalBits - kHeightBits)) + (patches * 15 >> 8)) >> 2;
  const std::int64_t shade = kColor + ((36 * patches + 31 * grain) >> 8);
  const auto mixed = [](std::int64_t a, std::int64_t b, std::int64_t w) {
    return a + (((b - a) * w + kWeights / 2) >> kWeightBits);
  };
  const auto channel = [&](std::int64_t ground, std::int64_t low, std::int64_t high, std::int64_t cliff) {
    return (ground * mixed(mixed(low, high, pale), cliff, steep) >> 8) * shade >> kColorBits;
  };
  return {channel(base.x, 236, 287, 159), channel(base.y, 251, 261, 154), channel(base.z, 220, 241, 154)};
}

// The middle of texel i.
VOXMELT_RULE std::int64_t texel_middle(std::int64_t i, int fineness) {
  return (2 * i + 1) << (kPositionBits - 1 - fineness);
}

VOXMELT_RULE std::int32_t relief(std::int64_t i, std::int64_t j, int fineness) {
  return layered_noise(texel_middle(i, fineness), texel_middle(j, fineness), 2, 6, kRelief);
}

// The bump along an axis, between the reliefs of the texels before and behind.
VOXMELT_RULE std::int8_t bump(std::int32_t before, std::int32_t behind, int fineness) {
  return static_cast<std::int8_t>(std::clamp((before - behind) * 225 >> (15 - fineness), -128, 127));
}

// Adds a bump to a normal; in 2^-14.
VOXMELT_RULE Vector roughened(Vector normal, std::int64_t bump_x, std::int64_t bump_z) {
  return unit(normal + Vector{bump_x, 0, bump_z});
}

// The cut sides and the underside are darker. Rock has bands there, `band` being their noise; else it is 0.
VOXMELT_RULE Vector cut_color(Vector base, std::int64_t band) {
  return base * (2540 + (41 * band >> 8)) >> kColorBits;
}

// The noise of the bands, at middle i of quarters of a cell, and how far they are bent at a place of the
// sides, in 2^-20 cells.
inline constexpr int kBandFineness = 2;
VOXMELT_RULE std::int32_t band(std::int64_t i) {
  return layered_noise(texel_middle(i, kBandFineness), 0, 1, 4, kBand);
}
VOXMELT_RULE std::int32_t bend(std::int64_t x, std::int64_t z) {
  return noise(x >> 4, z >> 4, kBend) * 192;
}

}  // namespace voxmelt::picture
