// These pictures of numbers tell how far the surface is, and which way it faces (docs/output.md).
#pragma once

#include "kernel/scene/look.h"
#include "render/image/image.h"
#include "render/packet/picture.h"

namespace voxmelt::app {

struct SurfacePictures {
  render::Image16 depth, normals;
  double near = 0;  // cells from the eye to the plane from which depth counts
};

SurfacePictures surface_pictures(const render::Picture& picture, const scene::Camera& camera,
                                 render::Setting setting, int threads);

}  // namespace voxmelt::app
