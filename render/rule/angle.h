// Sine and cosine are computed by their power series in integers (docs/picture/definition.md, section 2).
#pragma once

#include <cstdint>

#include "render/rule/fixed_point.h"

namespace voxmelt::picture {

// Angles are in 2^-16 degrees.
inline constexpr std::int64_t kDegree = 65536;
inline constexpr std::int64_t kQuarterTurn = 90 * kDegree;

struct SineCosine {
  std::int64_t sine = 0, cosine = 0;  // kUnit is 1
};

inline constexpr std::int64_t kRadiansPerDegree = 1228166276394;  // 2^46 pi / 180

// Takes any angle of less than 2^16 degrees.
VOXMELT_RULE SineCosine sine_cosine(std::int64_t angle) {
  const std::int64_t quarter = floor_divided(angle, kQuarterTurn);
  const std::int64_t rest = angle - quarter * kQuarterTurn;  // 0 <= rest < a quarter turn
  const std::int64_t radians = rounded(rest * kRadiansPerDegree, 32);
  // The terms are x^n / n!. Cosine and sine take them in turn, with the signs + + - -.
  std::int64_t term = kUnit, sine = 0, cosine = kUnit;
  for (int n = 1; n <= 17; ++n) {
    term = (term * radians >> kUnitBits) / n;
    std::int64_t& sum = n % 2 == 0 ? cosine : sine;
    sum += n % 4 < 2 ? term : -term;
  }
  switch (quarter & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

}  // namespace voxmelt::picture
