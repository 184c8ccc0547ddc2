// A scene as it is drawn: all that pictures of it read, kept up to date, and the pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/scene/look.h"
#include "kernel/scene/shape/terrain.h"
#include "render/density/density_field.h"
#include "render/ground/ground_map.h"
#include "render/image/image.h"
#include "render/light/light_volume.h"
#include "render/packet/draw_picture.h"
#include "render/packet/field_bricks.h"
#include "render/packet/ground_columns.h"
#include "render/rule/shade.h"

namespace voxmelt::render {

class Picture {
 public:
  // Takes over a field. `changed`: bricks of the field that were filtered again since the last call, or null
  // for all. Another grid, look, lamp or terrain asks for all.
  void update(const DensityField& field, const scene::Look& look, const scene::Light& light,
              const scene::Terrain& terrain, const std::vector<std::uint32_t>* changed, int threads);

  Image draw(const scene::Camera& camera, Setting setting, int threads,
             const Packets& packets = best_packets()) const;
  SurfacePicture surface(const scene::Camera& camera, Setting setting, int threads,
                         const Packets& packets = best_packets()) const;

  // What the two above draw from. Points into this object.
  PictureData data(const picture::Camera& camera, Setting setting) const;

 private:
  picture::Look look_;
  picture::Paint paint_;
  FieldBricks bricks_;
  GroundMap ground_;
  GroundColumns columns_;
  LightVolume light_;
  bool obstacles_ = false;
};

}  // namespace voxmelt::render
