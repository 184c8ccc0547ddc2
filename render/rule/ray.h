// A ray is a row of samples, some of which lie in the grid (docs/picture/definition.md, sections 4 and 5).
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "render/rule/fixed_point.h"

namespace voxmelt::picture {

// Sample k of a ray lies at start + k step, for k = 0, 1, 2 ...
struct Ray {
  Vector start;  // in kCell
  Vector step;   // in kCell; see step_along
  constexpr Vector at(std::int64_t k) const { return start + step * k; }
};

// Returns the step along `direction`, of which only the ratios count. The step's largest component is from a
// half of 2^-spacing cells to all of that. The largest component of `direction` must be 2^(20 - spacing) or
// more.
VOXMELT_RULE Vector step_along(Vector direction, int spacing) {
  const int shift = bits_of(largest(direction) - 1) - (kPositionBits - spacing);
  return {rounded(direction.x, shift), rounded(direction.y, shift), rounded(direction.z, shift)};
}

struct Samples {
  std::int64_t first = 0, last = -1;  // none if first > last
};

// Returns which samples lie in the box low <= position < high.
VOXMELT_RULE Samples samples_in(const Ray& ray, Vector low, Vector high) {
  Samples in{0, std::numeric_limits<std::int64_t>::max()};
  const std::int64_t start[3] = {ray.start.x, ray.start.y, ray.start.z};
  const std::int64_t step[3] = {ray.step.x, ray.step.y, ray.step.z};
  const std::int64_t from[3] = {low.x, low.y, low.z}, to[3] = {high.x - 1, high.y - 1, high.z - 1};
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t before = from[axis] - start[axis], behind = to[axis] - start[axis];
    if (step[axis] == 0) {
      if (before > 0 || behind < 0) return {};
    } else if (step[axis] > 0) {
      in.first = std::max(in.first, ceil_divided(before, step[axis]));
      in.last = std::min(in.last, floor_divided(behind, step[axis]));
    } else {
      in.first = std::max(in.first, ceil_divided(-behind, -step[axis]));
      in.last = std::min(in.last, floor_divided(-before, -step[axis]));
    }
  }
  return in;
}

}  // namespace voxmelt::picture
