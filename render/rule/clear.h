// Clear matter lets a part of the light through. It is followed front to back along a ray
// (docs/picture/translucent.md).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "render/rule/crossing.h"
#include "render/rule/fixed_point.h"
#include "render/rule/light_grid.h"
#include "render/rule/look.h"
#include "render/rule/normal.h"

namespace voxmelt::picture {

// Ways in matter count in 2^-16 cells. Those of a ray are summed up to kMostWay.
inline constexpr int kWayBits = 16;
inline constexpr std::int32_t kMostWay = (1 << 27) - 1;

// Holds the share that passes, where kPassed is 1. Entry i is 2^(-i / 256). The last is 0, as less than 1/255
// would be left there. One entry more is read beside it.
inline constexpr int kPassedBits = 15;
inline constexpr std::int32_t kPassed = 1 << kPassedBits;
inline constexpr std::int32_t kNothingPasses = 2047;
using Passing = std::array<std::uint16_t, kNothingPasses + 2>;

VOXMELT_RULE Passing passing_table() {
  constexpr std::int64_t kStep = 1070838486;  // 2^(-1 / 256) in 2^30
  Passing table{};
  std::int64_t left = std::int64_t{1} << 30;
  for (std::int32_t i = 0; i < kNothingPasses; ++i) {
    table[i] = static_cast<std::uint16_t>(rounded(left, 30 - kPassedBits));
    left = rounded(left * kStep, 30);
  }
  return table;
}

// Returns how many entries of the table a cell takes, for each channel, in 1 / 16. The result is 4096 at
// most.
VOXMELT_RULE Color losses_of(const Color& clear) {
  Color color{};
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = std::min((1 << (12 + kClearBits)) / std::max(clear[c], 1), 1 << 12);
  return color;
}
VOXMELT_RULE bool is_clear(const Look& look) { return !look.glow && look.clear != Color{}; }

// Holds the share of the light from behind that surfaces and ways have left so far.
struct Left {
  std::int32_t surfaces = kLight;
  std::int32_t way = 0;
};

VOXMELT_RULE Color passed(const Passing& table, const Color& losses, Left left) {
  Color color{};
  for (std::size_t c = 0; c < 3; ++c) {
    const std::int32_t i = std::min(((left.way >> 8) * losses[c]) >> 12, kNothingPasses);
    color[c] = (left.surfaces * table[i]) >> kLightBits;
  }
  return color;
}

VOXMELT_RULE std::int32_t dimmed(std::int32_t surfaces, std::int32_t lost) {
  return (surfaces * (kLight - lost)) >> kLightBits;
}
VOXMELT_RULE std::int32_t further(std::int32_t way, std::int32_t by) { return std::min(way + by, kMostWay); }

// Returns the length of a step in 2^-16 cells. `to_eye` is its direction backwards, of kLength.
VOXMELT_RULE std::int32_t length_of_step(Vector step, Vector to_eye) {
  return static_cast<std::int32_t>(dot((Vector{} - step) >> (kPositionBits - kWayBits), to_eye) >>
                                   kNormalBits);
}

// Returns how dense clear matter is for the light of the scene, from its density 0 .. 255. Above the fringe,
// only `share` 256ths of the density are left.
VOXMELT_RULE std::int32_t thinned(std::int32_t density, std::int32_t share) {
  return density <= 12 ? density : 12 + (((density - 12) * share) >> 8);
}
// Returns the `share` of `thinned`. `shift` is that of the grid of light. A full cell of light absorbs the
// green light that does not pass through its width.
VOXMELT_RULE std::int32_t density_share(const Passing& table, const Color& losses, int shift) {
  const std::int32_t i = std::min(((1 << (shift + 8)) * losses[1]) >> 12, kNothingPasses);
  return (180 * (256 - (table[i] >> 7))) >> 8;
}

// Returns the light at a place in clear matter, from all sides. kLight is 1.
VOXMELT_RULE Color inner_light(const Color& lamp, const Color& from_below, const Color& from_above,
                               const Light& light) {
  const std::int32_t beside = light.open[0] + light.open[1] + light.open[4] + light.open[5];
  const std::int32_t above = ((2 * light.open[2] + beside) * 43) >> 9;
  const std::int32_t below = ((2 * light.open[3] + beside) * 43) >> 9;
  const std::int32_t direct = light.lamp + (light.lamp >> 7);
  Color color{};
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = ((from_above[c] * above + from_below[c] * below) >> 8) + ((lamp[c] * direct) >> 9);
  return color;
}

}  // namespace voxmelt::picture
