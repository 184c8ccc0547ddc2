// A box may be seen in a rectangle of the picture.
#pragma once

#include <cstdint>

#include "render/rule/camera.h"

namespace voxmelt::render {

// Bounds a rectangle in picture coordinates, ends included.
struct VisibleArea {
  double left = 1e300, right = -1e300, top = 1e300, bottom = -1e300;

  // Tells whether a ray through these places may meet what is seen here.
  bool overlaps(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1) const {
    return static_cast<double>(x0) <= right && static_cast<double>(x1) >= left &&
           static_cast<double>(y0) <= bottom && static_cast<double>(y1) >= top;
  }
};

class Projection {
 public:
  explicit Projection(const picture::View& view);
  // Returns the area of the box low <= position < high, in 2^-20 cells. It is nowhere if the box is empty.
  VisibleArea of(picture::Vector low, picture::Vector high) const;

 private:
  struct Axes {  // numbers of a position, all linear in it
    double depth, across, down;
  };
  double eye_[3];
  bool parallel_;  // if so, nothing is divided, and nothing is behind the eye
  // Each cell along an axis adds these. Across and down are still to be divided by the depth.
  Axes along_[3];
  double half_width_, half_height_;
};

}  // namespace voxmelt::render
