// Where in a picture a box may be seen, as a rectangle.
#pragma once

#include <cstdint>

#include "render/rule/camera.h"

namespace voxmelt::render {

class VisibleArea {
 public:
  // Of the box low <= position < high, in 2^-20 cells; nowhere if it is empty.
  VisibleArea(const picture::View& view, picture::Vector low, picture::Vector high);
  // May a ray through these places meet the box? In picture coordinates; the ends are included.
  bool overlaps(std::int64_t left, std::int64_t top, std::int64_t right, std::int64_t bottom) const {
    return static_cast<double>(left) <= right_ && static_cast<double>(right) >= left_ &&
           static_cast<double>(top) <= bottom_ && static_cast<double>(bottom) >= top_;
  }

 private:
  double left_ = 1e300, right_ = -1e300, top_ = 1e300, bottom_ = -1e300;
};

}  // namespace voxmelt::render
