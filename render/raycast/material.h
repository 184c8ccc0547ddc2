// What the surface of the matter is made of at a point.
#pragma once

#include "kernel/scene/look.h"
#include "render/density/density_field.h"
#include "render/raycast/sampler.h"

namespace voxmelt::render {

struct Material {
  Vec color;  // of diffusely reflected light
  Vec emission;
  float liquid = 0;    // 0 solid .. 1 liquid
  float obstacle = 0;  // 0 matter .. 1 obstacle
  float specular = 0;
  float shininess = 40;
  float metallic = 0;
};

// Solid and liquid colours and the temperature are blended by weight of matter; where the surface runs
// through cells that hold next to nothing, wider and wider surroundings decide, so that no speck shows.
// Obstacles have the ground's colour, a little lighter; it ends within a cell of where they do, and a film of
// a tenth of a cell hides it. The normal points out of the surface.
Material material_at(const DensityField& field, const Sampler& sampler, Vec point, Vec normal,
                     const scene::Look& look);

}  // namespace voxmelt::render
