// Look, lamp, camera and ground of a scene in the integers of the picture (docs/picture.md).
#pragma once

#include "kernel/scene/look.h"
#include "kernel/scene/shape/terrain.h"
#include "render/density/density_field.h"
#include "render/ground/ground_map.h"
#include "render/rule/camera.h"
#include "render/rule/look.h"

namespace voxmelt::render {

picture::Look look_in_integers(const scene::Look& look);
picture::Lamp lamp_in_integers(const scene::Light& light);
picture::Camera camera_in_integers(const scene::Camera& camera);

// Before columns are lowered. The heights come from the terrain, or from the field where the terrain does not
// fit it.
GroundMap ground_in_integers(const DensityField& field, const scene::Look& look,
                             const scene::Terrain& terrain);

}  // namespace voxmelt::render
