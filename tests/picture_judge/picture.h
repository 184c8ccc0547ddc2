// Hits of rays, samples, settings and bytes follow docs/picture/definition.md sections 9 and 10.
#pragma once

#include <string>
#include <vector>

#include "bytes.h"
#include "clear.h"
#include "rock.h"

struct Scene {
  explicit Scene(const Input& input)
      : in(input),
        columns(make_columns(in)),
        field(make_field(in, columns)),
        ground(in, columns),
        look(in),
        levels(in, field),
        bytes(in, look, field, levels),
        rock(in, ground, look.ground),
        grid(in, look, field, ground),
        view(make_view(in)) {}
  const Input& in;
  std::vector<Column> columns;
  Field field;
  Ground ground;
  Look look;
  Levels levels;
  MatterBytes bytes;
  Rock rock;
  LightGrid grid;
  View view;
  Press press;
};

inline Vec ground_color_of(const Scene& scene, const Ray& ray, const GroundHit& ground) {
  const GroundLook look = scene.rock.look_of(ground);
  const Vec normal = ground.face == Face::inside ? to_eye_of(ray) : look.normal;
  return ground_color(scene.look, scene.grid, ground.crossing, normal, look.color);
}

// Takes a sample: the pressed light of the ray through the place (X, Y).
inline Vec sample_of(const Scene& scene, Int X, Int Y, Int m) {
  const Ray ray = make_ray(scene.view, X, Y, m);
  const GroundHit ground = meet_ground(scene.ground, ray);
  if (scene.look.clear.is_clear) {
    const ClearScene clear{scene.look, scene.levels, scene.grid, scene.bytes};
    ClearWalk walk(clear, ray, m);
    return walk.walk(ground) ? walk.color_at_ground(scene.press, ground_color_of(scene, ray, ground))
                             : walk.color_at_background(scene.press);
  }
  const MatterHit matter = meet_matter(scene.levels, ray);
  if (ground.drawn_before(matter)) return scene.press(ground_color_of(scene, ray, ground));
  if (matter.met) {
    const Vec e = to_eye_of(ray), p = matter.crossing.position;
    const Vec normal = matter.at_start() ? e : matter_normal(scene.levels, p);
    return scene.press(matter_color(scene.look, scene.grid, scene.bytes, p, normal, e));
  }
  return scene.look.background;
}

// Tells what the middle of pixel (i, j) shows (0 nothing, 1 matter, 2 the ground), and where. z is that of
// section 8.
struct Met {
  Int kind = 0;
  Vec position;
  Int z = 0;
};
inline Met met_by(const Scene& scene, Int i, Int j, Int m) {
  const Ray ray = make_ray(scene.view, 64 * i + 32, 64 * j + 32, m);
  const GroundHit ground = meet_ground(scene.ground, ray);
  const MatterHit matter = meet_matter(scene.levels, ray);
  const bool on_ground = ground.drawn_before(matter);
  if (!on_ground && !matter.met) return {};
  const Vec crossing = on_ground ? ground.crossing : matter.crossing.position;
  return {on_ground ? 2 : 1, crossing, dot((crossing - scene.view.eye) >> 8, scene.view.forward) >> 30};
}

struct Place {
  Int x, y;
};  // in a pixel, in 64ths

inline std::vector<Place> places_of(int samples) {
  if (samples == 1) return {{32, 32}};
  const std::vector<Int> rows_of_8{3, 6, 0, 5, 2, 7, 1, 4};
  const std::vector<Int> rows_of_32{2,  15, 24, 28, 12, 4,  20, 16, 7,  22, 31, 1, 8,  14, 27, 11,
                                    19, 25, 30, 5,  21, 10, 3,  26, 17, 0,  13, 6, 23, 9,  29, 18};
  const std::vector<Int>& rows = samples == 8 ? rows_of_8 : rows_of_32;
  const Int unit = 64 / samples;
  std::vector<Place> places;
  for (Int i = 0; i < samples; ++i) places.push_back({unit * i + unit / 2, unit * rows[i] + unit / 2});
  return places;
}

inline Vec pixel_of(const Scene& scene, Int i, Int j, int samples, Int m) {
  Vec sum;
  for (const Place& place : places_of(samples))
    sum = sum + sample_of(scene, 64 * i + place.x, 64 * j + place.y, m);
  const Int half = samples / 2;
  const Vec light = (sum + Vec{half, half, half}) / samples;
  return {byte_of_light(light.x), byte_of_light(light.y), byte_of_light(light.z)};
}

inline Int m_of(const Scene& scene) { return (scene.in.setting == "best" ? 3 : 2) + scene.view.halvings; }

inline std::vector<Vec> draw_picture(const Scene& scene) {
  const Int W = scene.in.width, H = scene.in.height;
  const std::string& setting = scene.in.setting;
  const Int m = m_of(scene);
  std::vector<Vec> picture;
  for (Int j = 0; j < H; ++j)
    for (Int i = 0; i < W; ++i) picture.push_back(pixel_of(scene, i, j, 1, m));
  const auto redraw = [&](Int d, int samples) {
    const std::vector<Vec> before = picture;
    const auto differs = [&](Int i, Int j, Int i2, Int j2) {
      if (i2 < 0 || i2 >= W || j2 < 0 || j2 >= H) return false;
      return largest_magnitude(before[j * W + i] - before[j2 * W + i2]) > d;
    };
    for (Int j = 0; j < H; ++j)
      for (Int i = 0; i < W; ++i)
        if (differs(i, j, i - 1, j) || differs(i, j, i + 1, j) || differs(i, j, i, j - 1) ||
            differs(i, j, i, j + 1))
          picture[j * W + i] = pixel_of(scene, i, j, samples, m);
  };
  if (setting == "normal") redraw(16, 8);
  if (setting == "best") redraw(8, 32);
  return picture;
}
