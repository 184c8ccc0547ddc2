// From pixels to rays.
#pragma once

#include "kernel/automaton/state/grid.h"
#include "kernel/scene/look.h"
#include "render/image/vector.h"

namespace voxmelt::render {

class CameraView {
 public:
  // A camera whose distance is 0 is moved back until the whole grid is in the picture.
  CameraView(const scene::Camera& camera, const state::Grid& grid);

  // Pixel coordinates: x to the right, y down, (0, 0) the upper left corner of the picture.
  Ray ray(float pixel_x, float pixel_y) const;

  Vec position() const { return position_; }

 private:
  Vec position_, forward_, right_, up_;
  float half_width_ = 0, half_height_ = 0;  // of the picture, in pixels
  float tangent_ = 0;                       // of half the vertical field of view
};

}  // namespace voxmelt::render
