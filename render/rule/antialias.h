// Some pixels get more samples. The rule says which do, and where the samples lie
// (docs/picture/definition.md, section 10).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/rule/fixed_point.h"

namespace voxmelt::picture {

// Holds a place within a pixel, in 1 / kPixel.
struct Sub {
  std::int32_t across, down;
};
inline constexpr std::array<Sub, 1> kMiddle{{{32, 32}}};

// Returns places of which no two share a row or a column. The place of column i lies in row rows[i]. The rows
// come from a search (docs/results/picture-error.md). They err least over edges of any direction.
template <std::size_t kCount>
constexpr std::array<Sub, kCount> rooks(const std::array<std::int32_t, kCount>& rows) {
  constexpr std::int32_t kAll = kCount, kApart = 64 / kAll;
  std::array<Sub, kCount> values{};
  for (std::int32_t i = 0; i < kAll; ++i)
    values[i] = {kApart * i + kApart / 2, kApart * rows[i] + kApart / 2};
  return values;
}
inline constexpr auto kEight = rooks<8>({3, 6, 0, 5, 2, 7, 1, 4});
inline constexpr auto kThirtyTwo = rooks<32>({2,  15, 24, 28, 12, 4,  20, 16, 7,  22, 31, 1, 8,  14, 27, 11,
                                              19, 25, 30, 5,  21, 10, 3,  26, 17, 0,  13, 6, 23, 9,  29, 18});

// A pixel gets more samples if one of its bytes differs by more than this from a pixel beside, above or
// below. It then has kEight samples, or kThirtyTwo in the best picture.
inline constexpr int kDifference = 16, kFineDifference = 8;

VOXMELT_RULE bool differ(const std::array<std::uint8_t, 3>& a, const std::array<std::uint8_t, 3>& b,
                         int most) {
  bool found = false;
  for (std::size_t c = 0; c < 3; ++c) found |= magnitude(a[c] - b[c]) > most;
  return found;
}

}  // namespace voxmelt::picture
