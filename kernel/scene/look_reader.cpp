#include "kernel/scene/look_reader.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernel/scene/shape/geometry.h"
#include "kernel/scene/text/units.h"

namespace voxmelt::scene {
namespace {

Range unit() { return {0, 1, false, {}}; }

}  // namespace

Camera read_camera(Reader& root, state::Grid grid) {
  Camera camera;
  camera.target = {grid.x / 2.0, grid.y / 2.0, grid.z / 2.0};
  if (std::optional<Reader> reader = root.table("camera")) {
    camera.target =
        reader->vector<3>("target", {-kLargestCoordinate, kLargestCoordinate, false, {}}, camera.target);
    camera.azimuth = reader->number("azimuth", {-360, 360, false, {}}, camera.azimuth);
    camera.elevation = reader->number("elevation", {-89, 89, false, {}}, camera.elevation);
    camera.distance = reader->number("distance", {0, 4 * kLargestCoordinate, false, {}}, 0.0);
    camera.field_of_view = reader->number("field_of_view", {1, 120, false, {}}, camera.field_of_view);
    camera.width = static_cast<int>(reader->integer("width", 16, 16384, camera.width));
    camera.height = static_cast<int>(reader->integer("height", 16, 16384, camera.height));
    reader->finish();
  }
  return camera;
}

Light read_light(Reader& root) {
  Light light;
  std::optional<Reader> reader = root.table("light");
  if (!reader) return light;
  light.direction = reader->vector<3>("direction", {-1e6, 1e6, false, {}}, light.direction);
  if (length(to_point(light.direction)) < 1e-6) reader->fail("direction", " has no length");
  light.ambient = reader->number("ambient", unit(), light.ambient);
  reader->finish();
  return light;
}

Look read_look(Reader& root) {
  Look look;
  std::optional<Reader> reader = root.table("look");
  if (!reader) return look;
  look.solid = reader->vector<3>("solid", unit(), look.solid);
  look.liquid = reader->vector<3>("liquid", unit(), look.liquid);
  look.ground = reader->vector<3>("ground", unit(), look.ground);
  look.background = reader->vector<3>("background", unit(), look.background);
  look.shininess = reader->number("shininess", {1, 10000, false, {}}, look.shininess);
  look.specular = reader->number("specular", unit(), look.specular);
  look.metallic = reader->number("metallic", unit(), look.metallic);
  look.glow = reader->flag("glow", look.glow);
  look.glow_cold = reader->number("glow_cold", unit(), look.glow_cold);
  look.glow_hot = reader->number("glow_hot", unit(), look.glow_hot);
  if (look.glow_hot <= look.glow_cold) reader->fail("glow_hot", " must be more than glow_cold");
  look.smooth = static_cast<int>(reader->integer("smooth", 0, kMostSmooth, look.smooth));
  look.smooth_solid = static_cast<int>(reader->integer("smooth_solid", 0, kMostSmooth, look.smooth_solid));
  reader->finish();
  return look;
}

}  // namespace voxmelt::scene
