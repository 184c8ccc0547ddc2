// Where a ray first meets matter (docs/picture.md, section 7).
#pragma once

#include <algorithm>
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

inline constexpr std::int32_t kPlaces = (1 << kBisections) * kParts;  // of a step

struct Crossing {
  bool found = false;
  std::int64_t sample = 0;  // the first that lies in matter
  std::int32_t part = 0;    // of the step to that sample, 0 .. kPlaces
  Vector position;
};

// Between the positions of two samples, of which `k` is matter and the other one air: bisections, and then a
// straight line.
template <class Levels>
VOXMELT_RULE Crossing crossing_between(const Levels& levels, Vector outside, Vector inside, std::int64_t k) {
  std::int32_t low = sample(levels, outside), high = sample(levels, inside);
  std::int32_t part = 0;
  for (int i = 0; i < kBisections; ++i) {
    const Vector middle = outside + ((inside - outside) >> 1);
    const std::int32_t level = sample(levels, middle);
    part *= 2;
    if (level < 0) {
      outside = middle;
      low = level;
      ++part;
    } else {
      inside = middle;
      high = level;
    }
  }
  const std::int32_t last = false_position(low, high);
  return {true, k, part * kParts + last, outside + (((inside - outside) * last) >> 8)};
}

template <class Levels>
VOXMELT_RULE Crossing crossing_before(const Levels& levels, const Ray& ray, std::int64_t k) {
  return crossing_between(levels, ray.at(k - 1), ray.at(k), k);
}

// From sample `from` on. A ray that starts in matter meets it at its start.
template <class Levels>
VOXMELT_RULE Crossing first_crossing(const Levels& levels, Vector cells, const Ray& ray,
                                     std::int64_t from = 0) {
  const Samples in = samples_in(ray, field_low(), field_high(cells));
  for (std::int64_t k = std::max(in.first, from); k <= in.last; ++k) {
    if (sample(levels, ray.at(k)) < 0) continue;
    return k == 0 ? Crossing{true, 0, kPlaces, ray.start} : crossing_before(levels, ray, k);
  }
  return {};
}

}  // namespace voxmelt::picture
