// The field at a position gives a sample, the crossing between two, and the normal
// (docs/picture/definition.md, sections 6 to 8). Positions are in the lattice: cell -2 has place 0, so that
// the bits of a position are place and weight.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hwmodel/caster/model/arithmetic.h"

namespace voxmelt::hwmodel::raycast {

inline constexpr std::int64_t kLatticeBorder = 2;  // places before cell 0
inline constexpr std::int64_t kToLattice = kToSpot + kLatticeBorder * kCell;
inline Vec to_lattice(Vec p) { return {p.x + kToLattice, p.y + kToLattice, p.z + kToLattice}; }
inline Vec from_lattice(Vec q) { return {q.x - kToLattice, q.y - kToLattice, q.z - kToLattice}; }
inline std::int64_t weight_of(std::int64_t q) { return (q >> 12) & 255; }

// Takes fourteen products of 16 bits by 9. The `levels` are eight, x fastest.
inline SInt<16> sample_of(const std::int16_t* levels, Vec q) {
  const std::int64_t wx = weight_of(q.x), wy = weight_of(q.y), wz = weight_of(q.z);
  const SInt<16> a = blended(levels[0], levels[1], wx), b = blended(levels[2], levels[3], wx),
                 c = blended(levels[4], levels[5], wx), d = blended(levels[6], levels[7], wx);
  const SInt<16> below = blended(a, b, wy), above = blended(c, d, wy);
  return blended(below, above, wz);
}

// Holds two samples, outside and inside, with their levels.
struct Bracket {
  Vec outside, inside;
  SInt<16> a;
  UInt<15> b;
  UInt<3> e;
};
inline Vec middle_of(const Bracket& bracket) {
  return bracket.outside + ((bracket.inside - bracket.outside) >> 1);
}
// The level of the middle decides which end moves there.
inline void halve(Bracket& bracket, std::int64_t level) {
  const Vec middle = middle_of(bracket);
  const bool air = level < 0;
  bracket.e = 2 * bracket.e + (air ? 1 : 0);
  if (air) {
    bracket.outside = middle;
    bracket.a = level;
  } else {
    bracket.inside = middle;
    bracket.b = level;
  }
}
struct Crossing {
  bool found = false;
  std::int64_t sample = 0, part = 0;
  Vec position;  // not in the lattice
};
// Takes one quotient of nine bits.
inline Crossing crossing_of(const Bracket& bracket, std::int64_t sample) {
  const UInt<9> f = (-bracket.a * 256) / (bracket.b - bracket.a);
  const Vec at = bracket.outside + (((bracket.inside - bracket.outside) * f) >> 8);
  return {true, sample, UInt<12>(bracket.e * 256 + f), on_wires<32>(from_lattice(at))};
}

// Returns the middle one of the 27 places of a normal, along one axis.
inline std::int64_t middle_place(std::int64_t q) { return (q + kCell / 2) >> kCellBits; }

struct Slope {
  Vec slope, normal;
};
// Takes ninety products. The `levels` are 27, x fastest.
inline Slope slope_of(const std::int16_t* levels, Vec q) {
  struct Weights {
    std::array<std::int64_t, 3> value, slope;
  };
  const auto weights = [](std::int64_t place) {
    const std::int64_t u = ((place + kCell / 2) >> 12) & 255, t = 256 - u;
    const std::int64_t l = (t * t) >> 9, r = (u * u) >> 9;
    return Weights{{l, 256 - l - r, r}, {-t, t - u, u}};
  };
  const auto splined = [](std::int64_t a, std::int64_t b, std::int64_t c,
                          const std::array<std::int64_t, 3>& w,
                          int shift) { return SInt<17>(rounded(a * w[0] + b * w[1] + c * w[2], shift)); };
  const Weights x = weights(q.x), y = weights(q.y), z = weights(q.z);
  std::array<std::int64_t, 3> along_x{}, along_y{}, value{};  // one for each plane
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<std::int64_t, 3> slope_x{}, value_x{};  // one for each row
    for (std::size_t j = 0; j < 3; ++j) {
      const std::int16_t* row = levels + 9 * k + 3 * j;
      slope_x[j] = splined(row[0], row[1], row[2], x.slope, 9);
      value_x[j] = splined(row[0], row[1], row[2], x.value, 8);
    }
    along_x[k] = splined(slope_x[0], slope_x[1], slope_x[2], y.value, 8);
    along_y[k] = splined(value_x[0], value_x[1], value_x[2], y.slope, 9);
    value[k] = splined(value_x[0], value_x[1], value_x[2], y.value, 8);
  }
  const Vec slope{splined(along_x[0], along_x[1], along_x[2], z.value, 8),
                  splined(along_y[0], along_y[1], along_y[2], z.value, 8),
                  splined(value[0], value[1], value[2], z.slope, 9)};
  return {slope, unit(Vec{} - on_wires<16>(slope))};
}

}  // namespace voxmelt::hwmodel::raycast
