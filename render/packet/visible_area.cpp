#include "render/packet/visible_area.h"

#include <algorithm>
#include <cstdint>

namespace voxmelt::render {
namespace {

double along(picture::Vector a, picture::Vector b) {
  return static_cast<double>(a.x) * static_cast<double>(b.x) +
         static_cast<double>(a.y) * static_cast<double>(b.y) +
         static_cast<double>(a.z) * static_cast<double>(b.z);
}

}  // namespace

// The projection of a box before the eye lies within that of its corners. Rays are off their lines by the
// roundings of starts and steps, which are far below a cell within the grid: the box is taken a cell larger.
VisibleArea::VisibleArea(const picture::View& view, picture::Vector low, picture::Vector high) {
  if (low.x >= high.x || low.y >= high.y || low.z >= high.z) return;
  constexpr std::int64_t kMore = picture::kCell;
  constexpr auto kOne = static_cast<double>(picture::kUnit);
  const double tangent = along(view.wide, view.right) / (kOne * kOne);
  const auto half_height = static_cast<double>(view.half_height),
             half_width = static_cast<double>(view.half_width);
  for (int corner = 0; corner < 8; ++corner) {
    const picture::Vector from_eye = picture::Vector{(corner & 1) != 0 ? high.x + kMore : low.x - kMore,
                                                     (corner & 2) != 0 ? high.y + kMore : low.y - kMore,
                                                     (corner & 4) != 0 ? high.z + kMore : low.z - kMore} -
                                     view.eye;
    const double depth = along(from_eye, view.forward) / kOne;
    if (depth < static_cast<double>(picture::kCell)) {  // beside or behind the eye
      left_ = top_ = -1e300;
      right_ = bottom_ = 1e300;
      return;
    }
    const double scale = half_height / (depth * tangent * kOne);
    const double across = along(from_eye, view.right) * scale + half_width;
    const double down = half_height - along(from_eye, view.up) * scale;
    left_ = std::min(left_, across - 1);
    right_ = std::max(right_, across + 1);
    top_ = std::min(top_, down - 1);
    bottom_ = std::max(bottom_, down + 1);
  }
}

}  // namespace voxmelt::render
