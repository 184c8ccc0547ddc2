// Smooth noise on a lattice, in integers (docs/picture-ground.md, section 6).
#pragma once

#include <algorithm>
#include <cstdint>

#include "render/rule/fixed_point.h"
#include "render/rule/sample.h"

namespace voxmelt::picture {

inline constexpr int kNoiseBits = 12;  // fraction bits of a noise, of which one octave is within -1 .. 1

// 3 t^2 - 2 t^3, with 0 .. kWeights for 0 .. 1.
VOXMELT_RULE std::int32_t smooth(std::int32_t t) { return (t * t * (3 * kWeights - 2 * t)) >> 16; }

// 0 up to `low`, kWeights from `high` on, and smooth between.
VOXMELT_RULE std::int32_t smooth_step(std::int64_t low, std::int64_t high, std::int64_t value) {
  const std::int64_t t = (std::clamp(value, low, high) - low) * kWeights / (high - low);
  return smooth(static_cast<std::int32_t>(t));
}

// A number of a lattice's point, from -2^12 to 2^12 - 1. `kind` tells lattices apart.
VOXMELT_RULE std::int32_t lattice(std::int64_t u, std::int64_t v, std::uint32_t kind) {
  std::uint32_t h = static_cast<std::uint32_t>(u) * 0x8DA6B343u ^ static_cast<std::uint32_t>(v) * 0xD8163841u ^
                    kind * 0xCB1AB31Fu;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  h ^= h >> 15;
  return static_cast<std::int32_t>(h >> (31 - kNoiseBits)) - (1 << kNoiseBits);
}

// At (u, v), in 2^-20 of a lattice's spacing.
VOXMELT_RULE std::int32_t noise(std::int64_t u, std::int64_t v, std::uint32_t kind) {
  const auto weight = [](std::int64_t a) {
    return smooth(static_cast<std::int32_t>((a >> (kPositionBits - kWeightBits)) & (kWeights - 1)));
  };
  const std::int64_t i = u >> kPositionBits, j = v >> kPositionBits;
  const std::int32_t w = weight(u);
  return blended(blended(lattice(i, j, kind), lattice(i + 1, j, kind), w),
                 blended(lattice(i, j + 1, kind), lattice(i + 1, j + 1, kind), w), weight(v));
}

// Octaves of noise: each is half as strong as the one before it, turned by 45 degrees, which makes it finer by
// sqrt 2, and moved. Otherwise the lattices would line up. That of the first has a spacing of 2^spacing cells.
inline constexpr int kFinerBits = 8;  // fraction bits more, for what turning and small spacings need
inline constexpr std::int64_t kOctaveMoved = 5 * kCell << (kFinerBits - 4);  // 5/16

VOXMELT_RULE std::int32_t layered_noise(std::int64_t x, std::int64_t z, int spacing, int octaves,
                                        std::uint32_t kind) {
  std::int64_t u = x * (std::int64_t{1} << (kFinerBits - spacing)),
               v = z * (std::int64_t{1} << (kFinerBits - spacing));
  std::int32_t sum = 0;
  for (int i = 0; i < octaves; ++i) {
    sum += noise(u >> kFinerBits, v >> kFinerBits, kind + static_cast<std::uint32_t>(i)) >> i;
    const std::int64_t turned = u + v + kOctaveMoved;
    v = v - u + kOctaveMoved;
    u = turned;
  }
  return sum >> 1;
}

}  // namespace voxmelt::picture
