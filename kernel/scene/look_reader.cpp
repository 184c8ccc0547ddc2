#include "kernel/scene/look_reader.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "kernel/scene/shape/geometry.h"
#include "kernel/scene/text/ascii.h"
#include "kernel/scene/text/units.h"

namespace voxmelt::scene {
Camera read_camera(Reader& root, state::Grid grid) {
  Camera camera;
  camera.target = {grid.x / 2.0, grid.y / 2.0, grid.z / 2.0};
  if (std::optional<Reader> reader = root.table("camera")) {
    camera.target = reader->vector<3>("target", coordinate(), camera.target);
    camera.azimuth = reader->number("azimuth", within(kFullTurn), camera.azimuth);
    camera.elevation = reader->number("elevation", within(89), camera.elevation);
    camera.distance = reader->number("distance", at_most(4 * kLargestCoordinate), 0.0);
    camera.field_of_view = reader->number("field_of_view", at_least(1).at_most(120), camera.field_of_view);
    camera.orthographic = reader->choice("projection", {"perspective", "orthographic"}, 0) == 1;
    camera.width = reader->integer("width", 16, kWidestPicture, camera.width);
    camera.height = reader->integer("height", 16, kWidestPicture, camera.height);
    reader->finish();
  }
  return camera;
}

Light read_light(Reader& root) {
  Light light;
  std::optional<Reader> reader = root.table("light");
  if (!reader) return light;
  light.direction = reader->vector<3>("direction", within(1e6), light.direction);
  if (length(to_point(light.direction)) < 1e-6) reader->fail("direction", " has no length");
  light.ambient = reader->number("ambient", fraction(), light.ambient);
  reader->finish();
  return light;
}

namespace {

// Returns the linear part of an sRGB byte (IEC 61966-2-1), rounded so that every machine reads the same.
double linear(int byte) {
  const double part = byte / 255.0;
  const double light = part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
  return std::round(light * 10000) / 10000;
}

}  // namespace

Vec3 read_color(Reader& reader, const char* key, const Vec3& fallback) {
  if (!reader.has(key) || reader.kind(key) != Value::Kind::text)
    return reader.vector<3>(key, fraction(), fallback);
  const std::string text = reader.text(key);
  if (text.size() != 7 || text[0] != '#' ||
      text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
    reader.fail(key, " = \"" + text + "\": want \"#rrggbb\", or [r, g, b] from 0 to 1");
  const auto digit = [](char c) { return is_digit(c) ? c - '0' : lower_case(c) - 'a' + 10; };
  Vec3 color{};
  for (std::size_t i = 0; i < 3; ++i) color[i] = linear(16 * digit(text[1 + 2 * i]) + digit(text[2 + 2 * i]));
  return color;
}

namespace {

Vec3 read_clear(Reader& reader, const Vec3& fallback) {
  const Range range = at_most(256);
  if (reader.has("clear") && reader.kind("clear") != Value::Kind::array) {
    const double all = reader.number("clear", range);
    return {all, all, all};
  }
  return reader.vector<3>("clear", range, fallback);
}

}  // namespace

Look read_look(Reader& root) {
  Look look;
  std::optional<Reader> reader = root.table("look");
  if (!reader) return look;
  look.solid = read_color(*reader, "solid", look.solid);
  look.liquid = read_color(*reader, "liquid", look.liquid);
  look.ground = read_color(*reader, "ground", look.ground);
  look.background = read_color(*reader, "background", look.background);
  look.shininess = reader->number("shininess", at_least(1).at_most(10000), look.shininess);
  look.specular = reader->number("specular", fraction(), look.specular);
  look.metallic = reader->number("metallic", fraction(), look.metallic);
  look.glow = reader->flag("glow", look.glow);
  look.glow_cold = reader->number("glow_cold", fraction(), look.glow_cold);
  look.glow_hot = reader->number("glow_hot", fraction(), look.glow_hot);
  if (look.glow_hot <= look.glow_cold) reader->fail("glow_hot", " must be more than glow_cold");
  look.clear = read_clear(*reader, look.clear);
  if (look.glow && look.clear != Vec3{}) reader->fail("clear", " is for matter that does not glow");
  look.frost = reader->number("frost", fraction(), look.frost);
  look.smooth = reader->integer("smooth", 0, kMostSmooth, look.smooth);
  look.smooth_solid = reader->integer("smooth_solid", 0, kMostSmooth, look.smooth_solid);
  reader->finish();
  return look;
}

}  // namespace voxmelt::scene
