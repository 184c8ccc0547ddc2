// The picture of a field: ray casting in software.
#pragma once

#include "kernel/scene/look.h"
#include "kernel/scene/shape/terrain.h"
#include "render/density/density_field.h"
#include "render/image/image.h"

namespace voxmelt::render {

struct DrawSettings {
  int antialias = 2;       // samples per pixel along each axis
  int threads = 0;         // 0: one for each processor; the picture is the same for any number
  bool skip_empty = true;  // leave out bricks without surface; the picture is the same
};

// Where `terrain` is empty or of another size, the ground is what the field's inert cells say. The field must
// have been updated at least once.
Image draw(const DensityField& field, const scene::Camera& camera, const scene::Light& light,
           const scene::Look& look, const scene::Terrain& terrain, const DrawSettings& settings = {});

}  // namespace voxmelt::render
