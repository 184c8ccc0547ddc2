// The unit normal of the surface (docs/picture.md, section 8).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/rule/fixed_point.h"
#include "render/rule/sample.h"

namespace voxmelt::picture {

inline constexpr int kNormalBits = 14;  // fraction bits of a normal
inline constexpr std::int32_t kLength = 1 << kNormalBits;

// floor(sqrt(a)), a < 2^40.
VOXMELT_RULE std::int64_t square_root(std::int64_t a) {
  std::int64_t root = 0;
  for (std::int64_t bit = std::int64_t{1} << 19; bit > 0; bit >>= 1)
    if ((root + bit) * (root + bit) <= a) root += bit;
  return root;
}

// 2^15 / sqrt(i / 128) to the nearest integer, i = 128 .. 512.
inline constexpr int kRootFirst = 128;
inline constexpr auto kInverseRoot = [] {
  std::array<std::int32_t, 385> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto divisor = static_cast<std::int64_t>(i) + kRootFirst;
    table[i] = static_cast<std::int32_t>((square_root((std::int64_t{1} << 39) / divisor) + 1) >> 1);
  }
  return table;
}();

// 2^15 / sqrt(m / 2^30), 2^30 <= m < 2^32, by a straight line between two entries.
VOXMELT_RULE std::int64_t inverse_root(std::int64_t m) {
  const auto i = static_cast<std::size_t>((m >> 23) - kRootFirst);
  return kInverseRoot[i] - rounded((kInverseRoot[i] - kInverseRoot[i + 1]) * (m & 0x7FFFFF), 23);
}

// A vector of components within 2^15, stretched or shrunk to the length 2^14; 0 stays 0.
VOXMELT_RULE Vector unit(Vector a) {
  if (a == Vector{}) return a;
  a = a * (std::int64_t{1} << (15 - bits_of(largest(a))));
  const std::int64_t square = dot(a, a);  // 2^28 <= square < 2^32
  const int more = square < std::int64_t{1} << 30 ? 1 : 0;
  const std::int64_t scale = inverse_root(square << (2 * more)) << more;
  return {rounded(a.x * scale, 16), rounded(a.y * scale, 16), rounded(a.z * scale, 16)};
}

// Out of the matter: the differences of samples half a cell before and behind.
template <class Levels>
VOXMELT_RULE Vector normal_at(const Levels& levels, Vector position) {
  const auto fall = [&](Vector half) -> std::int64_t {
    return (sample(levels, position - half) - sample(levels, position + half)) >> 1;
  };
  return unit({fall({kCell / 2, 0, 0}), fall({0, kCell / 2, 0}), fall({0, 0, kCell / 2})});
}

}  // namespace voxmelt::picture
