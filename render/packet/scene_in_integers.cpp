#include "render/packet/scene_in_integers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "render/density/tones.h"

namespace voxmelt::render {
namespace {

// Rounds to nearest, with halves upwards. The sum of `exact` and 1/2 could round, so it is avoided.
std::int64_t fixed(double value, int bits) {
  const double exact = std::ldexp(value, bits), below = std::floor(exact);
  return static_cast<std::int64_t>(below) + (exact - below >= 0.5 ? 1 : 0);
}

std::int32_t light(double value) { return static_cast<std::int32_t>(fixed(value, picture::kLightBits)); }

picture::Color color(const scene::Vec3& vec3) { return {light(vec3[0]), light(vec3[1]), light(vec3[2])}; }

}  // namespace

picture::Look look_in_integers(const scene::Look& look) {
  picture::Look result;
  result.solid = color(look.solid);
  result.liquid = color(look.liquid);
  result.ground = color(look.ground);
  result.background = color(look.background);
  result.shininess = static_cast<std::int32_t>(std::max<std::int64_t>(fixed(look.shininess, 0), 1));
  result.specular = light(look.specular);
  result.metallic = light(look.metallic);
  for (std::size_t c = 0; c < 3; ++c)
    result.clear[c] = static_cast<std::int32_t>(fixed(look.clear[c], picture::kClearBits));
  result.frost = light(look.frost);
  result.glow = look.glow;
  result.glow_cold = static_cast<std::int32_t>(fixed(look.glow_cold, 16));
  result.glow_hot = static_cast<std::int32_t>(fixed(look.glow_hot, 16));
  for (const Tint& tint : tints_of(look)) {
    if (static_cast<std::size_t>(result.tint_count) == picture::kMostTints) break;
    result.tints[static_cast<std::size_t>(result.tint_count++)] = tint;
  }
  return result;
}

picture::Lamp lamp_in_integers(const scene::Light& light) {
  const auto& d = light.direction;
  int bits = 0;  // exponent that brings the largest component to 1/2 .. 1
  std::frexp(std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}), &bits);
  return {{fixed(d[0], 24 - bits), fixed(d[1], 24 - bits), fixed(d[2], 24 - bits)},
          render::light(light.ambient)};
}

picture::Camera camera_in_integers(const scene::Camera& camera) {
  const auto position = [](double value) { return fixed(value, picture::kPositionBits); };
  return {{position(camera.target[0]), position(camera.target[1]), position(camera.target[2])},
          fixed(camera.distance, 12),
          fixed(camera.azimuth, 16),
          fixed(std::clamp(camera.elevation, -89.0, 89.0), 16),
          fixed(camera.field_of_view, 15),
          camera.width,
          camera.height,
          camera.orthographic};
}

double distance_of(const scene::Camera& camera, const state::Grid& grid) {
  return std::ldexp(
      static_cast<double>(picture::view_of(camera_in_integers(camera), {grid.x, grid.y, grid.z}).distance),
      -12);
}

GroundMap ground_in_integers(const DensityField& field, const scene::Look& look,
                             const scene::Terrain& terrain) {
  const state::Grid& grid = field.grid();
  return {{grid.x, grid.y, grid.z},
          fits(terrain, grid) ? ground_heights(terrain) : field.ground(),
          field.liquid_passes(),
          look.ground,
          terrain.textured && fits(terrain, grid)};
}

}  // namespace voxmelt::render
