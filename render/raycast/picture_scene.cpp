#include "render/raycast/picture_scene.h"

#include <cstdint>
#include <algorithm>
#include <cmath>

#include "render/light/light_matter.h"

namespace voxmelt::render {
namespace {

std::int64_t fixed(double value, int bits) {
  return static_cast<std::int64_t>(std::floor(std::ldexp(value, bits) + 0.5));
}

std::int32_t light(double value) { return static_cast<std::int32_t>(fixed(value, picture::kLightBits)); }

picture::Color color(const scene::Vec3& of) { return {light(of[0]), light(of[1]), light(of[2])}; }

// The heights come from the terrain, or from the field where the terrain does not fit it.
GroundMap ground_of(const DensityField& field, const scene::Look& look, const scene::Terrain& terrain) {
  const state::Grid& grid = field.grid();
  GroundMap map({grid.x, grid.y, grid.z},
                fits(terrain, grid) ? ground_heights(terrain) : field.ground(), field.liquid_passes(),
                look.ground, terrain.textured);
  map.lower(field.wetness());
  return map;
}

}  // namespace

picture::Look look_in_integers(const scene::Look& look) {
  picture::Look of;
  of.solid = color(look.solid);
  of.liquid = color(look.liquid);
  of.ground = color(look.ground);
  of.background = color(look.background);
  of.shininess = static_cast<std::int32_t>(std::max<std::int64_t>(fixed(look.shininess, 0), 1));
  of.specular = light(look.specular);
  of.metallic = light(look.metallic);
  of.glow = look.glow;
  of.glow_cold = static_cast<std::int32_t>(fixed(look.glow_cold, 16));
  of.glow_hot = static_cast<std::int32_t>(fixed(look.glow_hot, 16));
  return of;
}

picture::Lamp lamp_in_integers(const scene::Light& light) {
  const auto& d = light.direction;
  return {{fixed(d[0], 24), fixed(d[1], 24), fixed(d[2], 24)}, render::light(light.ambient)};
}

PictureScene::PictureScene(const DensityField& field, const scene::Look& scene_look, const scene::Light& scene_light,
                           const scene::Terrain& terrain)
    : look(look_in_integers(scene_look)),
      paint(picture::paint_of(look, lamp_in_integers(scene_light))),
      levels(field),
      matter(field, levels, look),
      ground(ground_of(field, scene_look, terrain)),
      light(light_matter(field, ground.drawn(), look), paint.to_light, picture::light_shift(levels.cells())) {}

}  // namespace voxmelt::render
