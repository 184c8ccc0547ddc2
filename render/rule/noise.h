// Smooth noise is interpolated on a lattice, in integers (docs/picture/ground.md, section 6).
#pragma once

#include <algorithm>
#include <cstdint>

#include "render/rule/fixed_point.h"
#include "render/rule/sample.h"

namespace voxmelt::picture {

inline constexpr int kNoiseBits = 12;  // fraction bits of a noise; one octave is within -1 .. 1

// Returns 3 t^2 - 2 t^3, with 0 .. kWeights for 0 .. 1.
VOXMELT_RULE std::int32_t smooth(std::int32_t t) { return (t * t * (3 * kWeights - 2 * t)) >> 16; }

// Returns 0 up to `low`, kWeights from `high` on, and smooth values between.
VOXMELT_RULE std::int32_t smooth_step(std::int64_t low, std::int64_t high, std::int64_t value) {
  const std::int64_t t = (std::clamp(value, low, high) - low) * kWeights / (high - low);
  return smooth(static_cast<std::int32_t>(t));
}

// Returns the number of a lattice's point, from -2^12 to 2^12 - 1. `kind` tells lattices apart.
VOXMELT_RULE std::int32_t lattice(Vector point, std::uint32_t kind) {
  std::uint32_t h = static_cast<std::uint32_t>(point.x) * 0x8DA6B343u ^
                    static_cast<std::uint32_t>(point.y) * 0xD8163841u ^
                    static_cast<std::uint32_t>(point.z) * 0xCB1AB31Fu ^ kind * 0x9E3779B1u;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  h ^= h >> 15;
  return (h >> (31 - kNoiseBits)) - (1 << kNoiseBits);
}

// Returns the noise at a position in 2^-20 of the lattice's spacing.
VOXMELT_RULE std::int32_t noise(Vector position, std::uint32_t kind) {
  const auto weight = [](std::int64_t a) { return smooth(weight_at(a)); };
  const Vector low = position >> kPositionBits;
  const std::int32_t wx = weight(position.x), wy = weight(position.y), wz = weight(position.z);
  const auto along_x = [&](std::int64_t dy, std::int64_t dz) {
    return blended(lattice(low + Vector{0, dy, dz}, kind), lattice(low + Vector{1, dy, dz}, kind), wx);
  };
  return blended(blended(along_x(0, 0), along_x(1, 0), wy), blended(along_x(0, 1), along_x(1, 1), wy), wz);
}

// Each octave of noise is half as strong and half as wide as the one before it. Its axes are exchanged and
// moved, or the lattices would line up. The lattice of the first octave has a spacing of 2^spacing cells.
inline constexpr Vector kOctaveMoved{17 * kCell / 16, 91 * kCell / 16, 501 * kCell / 16};

VOXMELT_RULE std::int32_t layered_noise(Vector position, int spacing, int octaves, std::uint32_t kind) {
  Vector p = position >> spacing;
  std::int32_t sum = 0;
  for (int i = 0; i < octaves; ++i) {
    sum += noise(p, kind + i) >> i;
    p = Vector{p.z, p.x, p.y} * 2 + kOctaveMoved;
  }
  return sum * 9 >> 4;
}

}  // namespace voxmelt::picture
