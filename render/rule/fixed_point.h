// The picture has these number formats (docs/picture/definition.md, section 1).
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"

namespace voxmelt::picture {

inline constexpr int kPositionBits = 20;  // fraction bits of a position, in cells
inline constexpr std::int64_t kCell = std::int64_t{1} << kPositionBits;
inline constexpr int kUnitBits = 30;  // fraction bits of the camera's unit vectors
inline constexpr std::int64_t kUnit = std::int64_t{1} << kUnitBits;

struct Vector {
  std::int64_t x = 0, y = 0, z = 0;

  friend constexpr Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vector operator*(Vector a, std::int64_t s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vector operator>>(Vector a, int n) { return {a.x >> n, a.y >> n, a.z >> n}; }
  friend constexpr bool operator==(const Vector&, const Vector&) = default;
};

VOXMELT_RULE std::int64_t dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

VOXMELT_RULE std::int64_t magnitude(std::int64_t a) { return a < 0 ? -a : a; }

// Returns the largest magnitude of a component.
VOXMELT_RULE std::int64_t largest(Vector a) {
  return std::max(std::max(magnitude(a.x), magnitude(a.y)), magnitude(a.z));
}

// Returns how many bits a >= 0 takes. This is the least n with a < 2^n.
VOXMELT_RULE int bits_of(std::int64_t a) {
  return static_cast<int>(std::bit_width(static_cast<std::uint64_t>(a)));
}

// These return floor(a / b) and ceil(a / b), where b > 0.
VOXMELT_RULE std::int64_t floor_divided(std::int64_t a, std::int64_t b) {
  return a / b - (a % b < 0 ? 1 : 0);
}
VOXMELT_RULE std::int64_t ceil_divided(std::int64_t a, std::int64_t b) { return -floor_divided(-a, b); }

// Returns a / 2^n to the nearest integer, with halves upwards and n > 0.
VOXMELT_RULE std::int64_t rounded(std::int64_t a, int n) { return (a + (std::int64_t{1} << (n - 1))) >> n; }

}  // namespace voxmelt::picture
