// Where a ray runs through a box that has one corner at the origin.
#pragma once

#include <algorithm>
#include <limits>

#include "render/image/vector.h"

namespace voxmelt::render {

struct Span {
  float from = 0, to = -1;  // empty when from > to
  Vec entry_normal;         // of the face through which the ray enters; zero when it starts inside
  bool empty() const { return from > to; }
};

inline Span clip(const Ray& ray, Vec low, Vec high) {
  Span span{0, std::numeric_limits<float>::max(), {}};
  const auto axis = [&](float origin, float direction, float lower, float upper, Vec unit) {
    if (direction == 0) {
      if (origin < lower || origin > upper) span.to = -1;
      return;
    }
    const float a = (lower - origin) / direction, b = (upper - origin) / direction;
    if (std::min(a, b) > span.from) {
      span.from = std::min(a, b);
      span.entry_normal = direction > 0 ? -unit : unit;
    }
    span.to = std::min(span.to, std::max(a, b));
  };
  axis(ray.origin.x, ray.direction.x, low.x, high.x, {1, 0, 0});
  axis(ray.origin.y, ray.direction.y, low.y, high.y, {0, 1, 0});
  axis(ray.origin.z, ray.direction.z, low.z, high.z, {0, 0, 1});
  return span;
}

}  // namespace voxmelt::render
