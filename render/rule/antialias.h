// Which pixels get more samples, and where these lie (docs/picture.md, section 9).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/rule/fixed_point.h"

namespace voxmelt::picture {

// A place within a pixel, in 1 / kPixel.
struct Sub {
  std::int32_t across, down;
};
inline constexpr std::array<Sub, 1> kMiddle{{{16, 16}}};
// No two share a row or a column.
inline constexpr std::array<Sub, 4> kFour{{{12, 4}, {28, 12}, {4, 20}, {20, 28}}};
inline constexpr std::array<Sub, 16> kSixteen = [] {
  std::array<Sub, 16> of{};
  for (std::int32_t i = 0; i < 16; ++i) {
    const std::int32_t a = i / 4, b = i % 4;
    of[static_cast<std::size_t>(i)] = {2 * (4 * a + b) + 1, 2 * (4 * b + a) + 1};
  }
  return of;
}();

// Bytes by which a pixel differs from one beside, above or below it: then it is drawn with kFour, and for
// the best picture those that still differ with kSixteen.
inline constexpr int kDifference = 8, kFineDifference = 3;

VOXMELT_RULE bool differ(const std::array<std::uint8_t, 3>& a, const std::array<std::uint8_t, 3>& b, int most) {
  bool found = false;
  for (std::size_t c = 0; c < 3; ++c) found |= magnitude(a[c] - b[c]) > most;
  return found;
}

}  // namespace voxmelt::picture
