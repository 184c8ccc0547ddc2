// The ray caster has its own arithmetic, written from docs/picture/definition.md and its pages alone. If it
// shared code with render/rule, their agreement would prove nothing.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "hwmodel/fabric/wires.h"

namespace voxmelt::hwmodel::raycast {

inline constexpr int kCellBits = 20;  // fraction bits of a position
inline constexpr std::int64_t kCell = std::int64_t{1} << kCellBits;
inline constexpr std::int64_t kAir = -32640;  // the level of air

struct Vec {
  std::int64_t x = 0, y = 0, z = 0;

  friend constexpr Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec operator*(Vec a, std::int64_t s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec operator>>(Vec a, int n) { return {a.x >> n, a.y >> n, a.z >> n}; }
  friend constexpr bool operator==(const Vec&, const Vec&) = default;
};

// Holds red, green and blue.
using Rgb = std::array<std::int32_t, 3>;

// Puts a vector on three wires of N bits.
template <int N>
Vec on_wires(Vec v) {
  return {SInt<N>(v.x), SInt<N>(v.y), SInt<N>(v.z)};
}
template <int N>
void check_wires(const Rgb& c) {
  for (const std::int32_t one : c) static_cast<void>(UInt<N>(one));
}

inline std::int64_t rounded(std::int64_t a, int n) { return (a + (std::int64_t{1} << (n - 1))) >> n; }
inline std::int64_t magnitude(std::int64_t a) { return a < 0 ? -a : a; }
inline std::int64_t largest(Vec v) {
  return std::max(magnitude(v.x), std::max(magnitude(v.y), magnitude(v.z)));
}
inline std::int64_t dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
// Returns the least n with a < 2^n, by a leading-zero count.
inline int bits_of(std::int64_t a) { return static_cast<int>(std::bit_width<std::uint64_t>(a)); }

// Takes two products of 16 bits by 9.
inline std::int64_t blended(std::int64_t a, std::int64_t b, std::int64_t weight) {
  return (a * (256 - weight) + b * weight + 128) >> 8;
}

// Holds cell and weight of one axis (docs/picture/definition.md, section 6).
struct Spot {
  std::int64_t cell = 0, weight = 0;
};
inline constexpr std::int64_t kToSpot = (std::int64_t{1} << 11) - (std::int64_t{1} << 19);
inline Spot spot_of(std::int64_t position) {
  const std::int64_t s = position + kToSpot;
  return {s >> kCellBits, (s >> 12) & 255};
}
struct Spots {
  Spot x, y, z;
};
inline Spots spots_of(Vec position) {
  return {spot_of(position.x), spot_of(position.y), spot_of(position.z)};
}

// Tabulates the inverse root: R[i] = 2^15 / sqrt(i / 128) for i = 128 .. 512, a memory of 385 words (section
// 8).
inline constexpr auto kInverseRoot = [] {
  std::array<std::uint16_t, 385> values{};
  for (std::int64_t i = 0; i < 385; ++i) {
    const std::int64_t square = (std::int64_t{1} << 39) / (i + 128);
    std::int64_t root = 0;
    for (std::int64_t bit = std::int64_t{1} << 20; bit > 0; bit >>= 1)
      if ((root + bit) * (root + bit) <= square) root += bit;
    values[i] = static_cast<std::uint16_t>((root + 1) >> 1);
  }
  return values;
}();

// Brings a vector of components within 2^15 to the length 2^14, while 0 stays 0. It takes three squares, one
// product of the root's slope and three of the root.
inline Vec unit(Vec g) {
  if (g == Vec{}) return {};
  const int n = 15 - bits_of(largest(g));
  g = on_wires<17>({g.x << n, g.y << n, g.z << n});
  const UInt<32> q = dot(g, g);
  const int e = q < (std::int64_t{1} << 30) ? 1 : 0;
  const UInt<32> m = q << (2 * e);
  const std::size_t i = static_cast<std::size_t>(m >> 23) - 128;
  const std::int64_t part = m & ((std::int64_t{1} << 23) - 1);
  const UInt<16> r = kInverseRoot[i] - rounded((kInverseRoot[i] - kInverseRoot[i + 1]) * part, 23);
  const std::int64_t by = std::int64_t{r} << e;
  return on_wires<16>({rounded(g.x * by, 16), rounded(g.y * by, 16), rounded(g.z * by, 16)});
}
inline Vec unit_of(Vec g) {
  const int bits = bits_of(largest(g));
  return unit(bits > 15 ? g >> (bits - 14) : g);
}

inline std::int64_t cosine(Vec a, Vec b) { return dot(a, b) >> 14; }

// In numbers of light, 4096 stands for 1.
inline std::int64_t times(std::int64_t a, std::int64_t b) { return rounded(a * b, 12); }
inline std::int32_t mixed(std::int64_t a, std::int64_t b, std::int64_t share) {
  return static_cast<std::int32_t>(a + times(b - a, share));
}
inline Rgb mixed(const Rgb& a, const Rgb& b, std::int64_t share) {
  return {mixed(a[0], b[0], share), mixed(a[1], b[1], share), mixed(a[2], b[2], share)};
}
// Returns floor(a / b) for b > 0, by one divider.
inline std::int64_t divided(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }
inline std::int64_t smooth(std::int64_t low, std::int64_t high, std::int64_t at) {
  const std::int64_t t = std::clamp<std::int64_t>(divided(4096 * (at - low), high - low), 0, 4096);
  return (t * t * (12288 - 2 * t)) >> 24;
}
inline std::int64_t whole(std::int64_t byte) { return byte + (byte >> 7); }

}  // namespace voxmelt::hwmodel::raycast
