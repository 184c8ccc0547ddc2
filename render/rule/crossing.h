// Where a ray first meets matter (docs/picture.md, section 7).
#pragma once

#include <cstdint>

#include "render/rule/fixed_point.h"
#include "render/rule/ray.h"
#include "render/rule/sample.h"

namespace voxmelt::picture {

inline constexpr int kBisections = 3;
inline constexpr std::int32_t kParts = 256;  // of the last interval

// The share of an interval at which a straight line from `outside` < 0 to `inside` >= 0 is 0, in kParts.
VOXMELT_RULE std::int32_t false_position(std::int32_t outside, std::int32_t inside) {
  return -outside * kParts / (inside - outside);
}

// Between a position outside of the matter and one inside: bisections, and then a straight line.
template <class Levels>
VOXMELT_RULE Vector crossing_between(const Levels& levels, Vector outside, Vector inside) {
  std::int32_t low = sample(levels, outside), high = sample(levels, inside);
  for (int i = 0; i < kBisections; ++i) {
    const Vector middle = outside + ((inside - outside) >> 1);
    const std::int32_t level = sample(levels, middle);
    if (level < 0) {
      outside = middle;
      low = level;
    } else {
      inside = middle;
      high = level;
    }
  }
  return outside + (((inside - outside) * false_position(low, high)) >> 8);
}

struct Crossing {
  bool found = false;
  std::int64_t sample = 0;  // the first that lies in matter
  Vector position;
};

// A ray that starts in matter meets it at its start.
template <class Levels>
VOXMELT_RULE Crossing first_crossing(const Levels& levels, Vector cells, const Ray& ray) {
  const Samples in = samples_in(ray, field_low(), field_high(cells));
  for (std::int64_t k = in.first; k <= in.last; ++k) {
    if (sample(levels, ray.at(k)) < 0) continue;
    return {true, k, k == 0 ? ray.start : crossing_between(levels, ray.at(k - 1), ray.at(k))};
  }
  return {};
}

}  // namespace voxmelt::picture
