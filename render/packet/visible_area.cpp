#include "render/packet/visible_area.h"

#include <algorithm>
#include <cstdint>

namespace voxmelt::render {
namespace {

constexpr auto kOne = static_cast<double>(picture::kUnit);
constexpr auto kCells = static_cast<double>(picture::kCell);

double dot_of(picture::Vector a, picture::Vector b) {
  return static_cast<double>(a.x) * static_cast<double>(b.x) +
         static_cast<double>(a.y) * static_cast<double>(b.y) +
         static_cast<double>(a.z) * static_cast<double>(b.z);
}

}  // namespace

Projection::Projection(const picture::View& view)
    : eye_{static_cast<double>(view.eye.x) / kCells, static_cast<double>(view.eye.y) / kCells,
           static_cast<double>(view.eye.z) / kCells},
      parallel_(view.wide == picture::Vector{}),
      half_width_(static_cast<double>(view.half_width)),
      half_height_(static_cast<double>(view.half_height)) {
  // These are the places to a cell, at a depth of one cell, or anywhere for parallel rays.
  constexpr double kLeast = 1e-12;  // cells to a place, if its vector is rounded to 0
  const double places = parallel_ ? 1 / std::max(dot_of(view.near_wide, view.right) / (kOne * kOne), kLeast)
                                  : half_height_ / (dot_of(view.wide, view.right) / (kOne * kOne));
  const double scale = places / kOne;
  const auto axis = [&](std::int64_t forward, std::int64_t right, std::int64_t up) {
    return Axes{static_cast<double>(forward) / kOne, static_cast<double>(right) * scale,
                static_cast<double>(-up) * scale};
  };
  along_[0] = axis(view.forward.x, view.right.x, view.up.x);
  along_[1] = axis(view.forward.y, view.right.y, view.up.y);
  along_[2] = axis(view.forward.z, view.right.z, view.up.z);
}

// Projects a box. The projection of a box before the eye lies within that of its corners. Rays are off their
// lines by the roundings of starts and steps. These are far below a cell within the grid, so the box is taken
// a cell larger.
VisibleArea Projection::of(picture::Vector low, picture::Vector high) const {
  VisibleArea area;
  if (low.x >= high.x || low.y >= high.y || low.z >= high.z) return area;
  const double from[3] = {static_cast<double>(low.x), static_cast<double>(low.y), static_cast<double>(low.z)},
               to[3] = {static_cast<double>(high.x), static_cast<double>(high.y),
                        static_cast<double>(high.z)};
  Axes ends[3][2];
  for (int axis = 0; axis < 3; ++axis) {
    const double places[2] = {from[axis] / kCells - 1 - eye_[axis], to[axis] / kCells + 1 - eye_[axis]};
    for (int end = 0; end < 2; ++end)
      ends[axis][end] = {along_[axis].depth * places[end], along_[axis].across * places[end],
                         along_[axis].down * places[end]};
  }
  for (int corner = 0; corner < 8; ++corner) {
    const Axes &x = ends[0][corner & 1], &y = ends[1][corner >> 1 & 1], &z = ends[2][corner >> 2];
    const double depth = x.depth + y.depth + z.depth;
    if (depth < 1 && !parallel_)  // beside or behind the eye
      return {-1e300, 1e300, -1e300, 1e300};
    const double nearer = parallel_ ? 1 : 1 / depth;
    const double across = (x.across + y.across + z.across) * nearer + half_width_;
    const double down = (x.down + y.down + z.down) * nearer + half_height_;
    area.left = std::min(area.left, across - 1);
    area.right = std::max(area.right, across + 1);
    area.top = std::min(area.top, down - 1);
    area.bottom = std::max(area.bottom, down + 1);
  }
  return area;
}

}  // namespace voxmelt::render
