// The ground has the colour and the roughness of rock (docs/picture/ground.md, sections 6 and 7).
//
// A colour is linear red, green and blue. kColor is 1.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "render/rule/fixed_point.h"
#include "render/rule/heights.h"
#include "render/rule/noise.h"
#include "render/rule/normal.h"
#include "render/rule/sample.h"
#include "render/rule/watch.h"

namespace voxmelt::picture {

inline constexpr int kColorBits = 12;
inline constexpr std::int32_t kColor = 1 << kColorBits;

// Returns the fineness of the texels, of which 2^fineness lie along a cell. They are a quarter of a million
// at most, up to 512 cells a side.
VOXMELT_RULE int texel_fineness(Vector cells) {
  const std::int64_t side = std::max(cells.x, cells.z);
  return side <= 128 ? 2 : side <= 256 ? 1 : 0;
}

// Holds the rock at a place of the top. Its relief adds bump_x and bump_z to the normal, in 2^-kBumpBits.
struct Texel {
  std::uint16_t red = 0, green = 0, blue = 0;
  std::int8_t bump_x = 0, bump_z = 0;
};
inline constexpr int kBumpBits = 8;

// Noises are numbered by these. Each octave takes one number more.
inline constexpr std::uint32_t kPatches = 0, kGrain = 16, kRelief = 32, kBand = 48, kBend = 64;

// Returns the elevation of a position of the top. It runs from 0 at the lowest column to kHeight at the
// highest.
VOXMELT_RULE std::int64_t elevation(std::int64_t y, std::int64_t lowest, std::int64_t highest) {
  const std::int64_t height = y >> (kPositionBits - kHeightBits);
  return (height - lowest) * kHeight / std::max<std::int64_t>(highest - lowest, 1);
}

// Returns the rock's colour. `elevation` is 0 .. kHeight from the lowest column to the highest, and `up` is
// the y of the normal.
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

// Returns the middle of texel i.
VOXMELT_RULE std::int64_t texel_middle(std::int64_t i, int fineness) {
  return (2 * i + 1) << (kPositionBits - 1 - fineness);
}

inline constexpr int kRockOctaves = 3, kReliefOctaves = 4;
VOXMELT_RULE std::int32_t patches(Vector place) { return layered_noise(place, 4, kRockOctaves, kPatches); }
VOXMELT_RULE std::int32_t grain(Vector place) { return layered_noise(place, 1, kRockOctaves, kGrain); }
VOXMELT_RULE std::int32_t relief(Vector place) { return layered_noise(place, 1, kReliefOctaves, kRelief); }

// Returns the bump along an axis, between the reliefs of the texels before and behind.
VOXMELT_RULE std::int8_t bump(std::int32_t before, std::int32_t behind, int fineness) {
  return static_cast<std::int8_t>(std::clamp((before - behind) * 225 >> (15 - fineness), -128, 127));
}

// Adds a bump to a normal. Both are in 2^-14.
template <class Watch = Silent>
VOXMELT_RULE Vector roughened(Vector normal, std::int64_t bump_x, std::int64_t bump_z, Watch watch = {}) {
  watch(Stage::texture, "bump", std::array{bump_x, bump_z});
  return unit(normal + Vector{bump_x, 0, bump_z}, watch);
}

// Returns the colour of the cut sides and the underside, which are darker. On rock, `band` is the noise of
// its bands, and otherwise 0.
VOXMELT_RULE Vector cut_color(Vector base, std::int64_t band) {
  return base * (2540 + (41 * band >> 8)) >> kColorBits;
}

// `band` returns the noise of the bands, at middle i of quarters of a cell. `bend` returns how far they are
// bent at a place of the sides, in 2^-20 cells.
inline constexpr int kBandFineness = 2;
VOXMELT_RULE std::int32_t band(std::int64_t i) {
  return layered_noise({0, texel_middle(i, kBandFineness), 0}, 1, 3, kBand);
}
VOXMELT_RULE std::int32_t bend(Vector place) { return noise(place >> 4, kBend) * 192; }

}  // namespace voxmelt::picture
