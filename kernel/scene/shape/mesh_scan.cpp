#include "kernel/scene/shape/mesh_scan.h"

#include <algorithm>
#include <cstddef>

namespace voxmelt::scene {
namespace {

std::int64_t floor_div(std::int64_t a, std::int64_t b) {
  const std::int64_t quotient = a / b;
  return a % b != 0 && (a < 0) != (b < 0) ? quotient - 1 : quotient;
}

}  // namespace

RayCrossings::RayCrossings(const Triangle& triangle, int axis, int row_axis) {
  const auto along = static_cast<std::size_t>(axis), v = static_cast<std::size_t>(row_axis),
             u = 3 - along - v;
  for (std::size_t i = 0; i < 3; ++i) corners_[i] = {triangle[i][u], triangle[i][v], triangle[i][along]};
  const auto [a, b, c] = corners_;
  area_ = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);  // at most 2^61
  if (area_ == 0) return;
  // Seen from the far end of the axis, an outer side runs counterclockwise if u, v and the axis are cyclic.
  sign_ = (area_ > 0) == ((along + 1) % 3 == u) ? 1 : -1;
  if (area_ > 0) return;
  area_ = -area_;
  std::swap(corners_[1], corners_[2]);
}

std::pair<std::int64_t, std::int64_t> RayCrossings::range_v() const {
  const auto [low, high] = std::minmax({corners_[0].v, corners_[1].v, corners_[2].v});
  return {low, high};
}

std::pair<std::int64_t, std::int64_t> RayCrossings::range_u(std::int64_t v) const {
  std::int64_t first = INT64_MIN, last = INT64_MAX;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &a = corners_[i], &b = corners_[(i + 1) % 3];
    const std::int64_t dv = b.v - a.v, n = (b.u - a.u) * (v - a.v);
    // A point (u, v) is left of the edge if n - dv (u - a.u) > 0. On an edge that rises it counts as left.
    if (dv > 0) {
      last = std::min(last, a.u + floor_div(n, dv));
    } else if (dv < 0) {
      first = std::max(first, a.u + floor_div(n, dv) + 1);
    } else if (n <= 0) {
      return {1, 0};
    }
  }
  return {first, last};
}

RayCrossings::Walk::Walk(const RayCrossings& crossings, std::int64_t u, std::int64_t v)
    : area_(static_cast<double>(crossings.area_)) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &a = crossings.corners_[(i + 1) % 3], &b = crossings.corners_[(i + 2) % 3];
    weight_[i] = (b.u - a.u) * (v - a.v) - (b.v - a.v) * (u - a.u);
    step_[i] = -(b.v - a.v) * kSampleSpacing;
    depth_[i] = static_cast<double>(crossings.corners_[i].depth);
  }
}

}  // namespace voxmelt::scene
