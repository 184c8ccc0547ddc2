// A picture in integers is drawn from this scene and a camera.
#pragma once

#include "kernel/scene/look.h"
#include "kernel/scene/shape/terrain.h"
#include "render/density/density_field.h"
#include "render/ground/ground_map.h"
#include "render/light/light_volume.h"
#include "render/reference/levels.h"
#include "render/reference/matter_cells.h"
#include "render/rule/shade.h"

namespace voxmelt::render {

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
