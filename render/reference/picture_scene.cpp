#include "render/reference/picture_scene.h"

#include "render/light/light_matter.h"
#include "render/packet/scene_in_integers.h"

namespace voxmelt::render {
namespace {

GroundMap lowered_ground(const DensityField& field, const scene::Look& look, const scene::Terrain& terrain) {
  GroundMap map = ground_in_integers(field, look, terrain);
  map.lower(field.wetness());
  return map;
}

}  // namespace

PictureScene::PictureScene(const DensityField& field, const scene::Look& scene_look,
                           const scene::Light& scene_light, const scene::Terrain& terrain)
    : look(look_in_integers(scene_look)),
      paint(picture::paint_of(look, lamp_in_integers(scene_light))),
      levels(field),
      matter(field, levels, look),
      ground(lowered_ground(field, scene_look, terrain)),
      light(light_matter(field, ground.drawn(), look), paint.to_light, picture::light_shift(levels.cells())) {
}

}  // namespace voxmelt::render
