// All that a picture in integers is drawn from, but for the camera.
#pragma once

#include "kernel/scene/look.h"
#include "render/density/density_field.h"
#include "kernel/scene/shape/terrain.h"
#include "render/light/light_volume.h"
#include "render/raycast/ground_map.h"
#include "render/raycast/levels.h"
#include "render/raycast/matter_cells.h"
#include "render/rule/shade.h"

namespace voxmelt::render {

picture::Look look_in_integers(const scene::Look& look);
picture::Lamp lamp_in_integers(const scene::Light& light);

struct PictureScene {
  PictureScene(const DensityField& field, const scene::Look& look, const scene::Light& light,
               const scene::Terrain& terrain);

  picture::Look look;
  picture::Paint paint;
  Levels levels;
  MatterCells matter;
  GroundMap ground;
  LightVolume light;
};

}  // namespace voxmelt::render
