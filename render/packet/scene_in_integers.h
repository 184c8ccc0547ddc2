// Look, lamp, camera and ground of a scene are converted to the integers of the picture
// (docs/picture/definition.md).
#pragma once

#include "kernel/automaton/state/grid.h"
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
// Returns the distance of a camera from its target, in cells. It is the camera's own, or that at which the
// grid fits into the picture.
double distance_of(const scene::Camera& camera, const state::Grid& grid);

// Returns the ground before columns are lowered. The heights come from the terrain, or from the field if the
// terrain does not fit it.
GroundMap ground_in_integers(const DensityField& field, const scene::Look& look,
                             const scene::Terrain& terrain);

}  // namespace voxmelt::render
