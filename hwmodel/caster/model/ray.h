// The place of a sample in the picture leads to its ray (docs/picture/definition.md, section 4). The inverse
// of its step tells how far a ray goes in how many samples. There are products and shifts, and no division.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "hwmodel/caster/model/arithmetic.h"
#include "hwmodel/caster/model/registers.h"

namespace voxmelt::hwmodel::raycast {

struct Ray {
  Vec start, step;  // place of sample 0, and the way to the next one
};

// Takes twelve products by u and v, which are below 2^20. The rest is the same for all rays of a picture.
inline Ray ray_of(const CameraRegisters& camera, std::int64_t across, std::int64_t down) {
  const SInt<21> u = across - 32 * std::int64_t{camera.width}, v = 32 * std::int64_t{camera.height} - down;
  const Vec direction =
      on_wires<53>(camera.forward * (32 * std::int64_t{camera.height}) + camera.wide * u + camera.high * v);
  const Vec start = on_wires<53>(camera.eye + ((camera.forward * camera.near) >> 14) +
                                 ((camera.near_wide * u + camera.near_high * v) >> 10));
  const int shift = bits_of(largest(direction) - 1) - kCellBits + camera.spacing;
  const Vec step =
      on_wires<20>({rounded(direction.x, shift), rounded(direction.y, shift), rounded(direction.z, shift)});
  return {start, step};
}

// Holds 1 / |step| of one axis, a little too small: a mantissa of 12 bits from a memory of 1024 words, and a
// shift.
struct Inverse {
  UInt<12> mantissa;
  UInt<6> shift;
};
inline constexpr auto kReciprocals = [] {
  std::array<std::uint16_t, 1024> values{};
  for (std::int32_t i = 0; i < 1024; ++i) values[i] = static_cast<std::uint16_t>((1 << 22) / (1024 + i + 1));
  return values;
}();
inline Inverse inverse_of(std::int64_t step) {
  const std::int64_t d = magnitude(step);
  if (d == 0) return {0, 0};
  const int bits = bits_of(d);
  const std::size_t i = ((d << 11) >> bits) - 1024;
  return {std::int64_t{kReciprocals[i]} & 4095, 11 + bits};
}
// Counts the steps that fit into a way, or a few less.
inline std::int64_t steps_in(std::int64_t way, Inverse inverse) {
  constexpr std::int64_t kMost = (std::int64_t{1} << 45) - 1;
  return (std::min(way, kMost) * inverse.mantissa) >> inverse.shift;
}

}  // namespace voxmelt::hwmodel::raycast
