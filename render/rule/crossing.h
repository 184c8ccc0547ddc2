// A ray first meets matter at its crossing (docs/picture/definition.md, section 7).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "render/rule/fixed_point.h"
#include "render/rule/ray.h"
#include "render/rule/sample.h"
#include "render/rule/watch.h"

namespace voxmelt::picture {

inline constexpr int kBisections = 3;
inline constexpr std::int32_t kParts = 256;  // parts of the last interval

// Returns the share of an interval at which a straight line is 0, in kParts. The line runs from `outside` < 0
// to `inside` >= 0.
VOXMELT_RULE std::int32_t false_position(std::int32_t outside, std::int32_t inside) {
  return -outside * kParts / (inside - outside);
}

inline constexpr std::int32_t kPlaces = (1 << kBisections) * kParts;  // places in a step

struct Crossing {
  bool found = false;
  std::int64_t sample = 0;  // first sample that lies in matter
  std::int32_t part = 0;    // part of the step to that sample, 0 .. kPlaces
  Vector position;
};

// Finds the crossing between the positions of two samples, of which `k` is matter and the other one air. It
// takes bisections, and then a straight line.
template <class Levels, class Watch = Silent>
VOXMELT_RULE Crossing crossing_between(const Levels& levels, Vector outside, Vector inside, std::int64_t k,
                                       Watch watch = {}) {
  std::int32_t low = sample(levels, outside, watch), high = sample(levels, inside, watch);
  std::int32_t part = 0;
  for (int i = 0; i < kBisections; ++i) {
    const Vector middle = outside + ((inside - outside) >> 1);
    watch(Stage::crossing, "middle", i + 1);
    const std::int32_t level = sample(levels, middle, watch);
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
  watch(Stage::crossing, "A", outside);
  watch(Stage::crossing, "B", inside);
  watch(Stage::crossing, "a", low);
  watch(Stage::crossing, "b", high);
  watch(Stage::crossing, "e", part);
  watch(Stage::crossing, "f", last);
  return {true, k, part * kParts + last, outside + (((inside - outside) * last) >> 8)};
}

template <class Levels, class Watch = Silent>
VOXMELT_RULE Crossing crossing_before(const Levels& levels, const Ray& ray, std::int64_t k,
                                      Watch watch = {}) {
  watch(Stage::crossing, "samples", std::array{k - 1, k});
  return crossing_between(levels, ray.at(k - 1), ray.at(k), k, watch);
}

// Finds the first crossing from sample `from` on. A ray that starts in matter meets it at its start.
template <class Levels, class Watch = Silent>
VOXMELT_RULE Crossing first_crossing(const Levels& levels, Vector cells, const Ray& ray,
                                     std::int64_t from = 0, Watch watch = {}) {
  const Samples in = samples_in(ray, field_low(), field_high(cells));
  watch(Stage::ray, "range", std::array{in.first, in.last});
  for (std::int64_t k = std::max(in.first, from); k <= in.last; ++k) {
    watch(Stage::sample, "k", k);
    if (sample(levels, ray.at(k), watch) < 0) continue;
    const Crossing met =
        k == 0 ? Crossing{true, 0, kPlaces, ray.start} : crossing_before(levels, ray, k, watch);
    watch(Stage::crossing, "sample", met.sample);
    watch(Stage::crossing, "part", met.part);
    watch(Stage::crossing, "crossing", met.position);
    return met;
  }
  return {};
}

}  // namespace voxmelt::picture
