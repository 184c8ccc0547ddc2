// The walk of a ray through clear matter follows docs/picture/translucent.md sections 2 to 7.
#pragma once

#include <algorithm>

#include "bytes.h"
#include "color.h"

// Holds what a walk needs to know of a scene.
struct ClearScene {
  const Look& look;
  const Levels& levels;
  const LightGrid& grid;
  const MatterBytes& bytes;
};

class ClearWalk {
 public:
  ClearWalk(const ClearScene& the_scene, const Ray& the_ray, Int the_m)
      : scene(the_scene), ray(the_ray), m(the_m), e(to_eye_of(ray)), length(dot(-ray.step >> 4, e) >> 14) {}

  // Walks as section 3 says. Tells if the walk ends at the ground.
  bool walk(const GroundHit& ground) {
    const Int G = ground.part >> 8;
    Int from = 0;
    for (;;) {
      const MatterHit hit = meet_matter(scene.levels, ray, from);
      if (ground.drawn_before(hit)) return true;
      if (!hit.met) return false;
      Int k = hit.sample;
      const Int p = hit.crossing.part;
      if (k > 0) cross(hit.crossing.position, true);
      if (nothing_passes()) return false;
      if (ground.met && k > G) {
        go(part(8 * ground.part - hit.place(), 11), k);
        return true;
      }
      Int d = part(2048 - p, 11);
      for (bool leaves = false; !leaves; d = 0) {
        for (Int step = 0; step < power_of_two(m) && !leaves && (!ground.met || k < G); ++step) {
          leaves = is_air(k + 1);
          if (leaves) continue;
          ++k;
          d += length;
        }
        Crossing out;
        if (leaves) {
          out = crossing_between(scene.levels, place_of_sample(ray, k + 1), place_of_sample(ray, k));
          d += part(2048 - out.part, 11);
        } else if (ground.met && k == G) {
          go(d + part(ground.part & 255, 8), k);
          return true;
        }
        go(d, k);
        if (leaves) cross(out.position, false);
        if (nothing_passes()) return false;
      }
      from = k + 1;
    }
  }
  // These give the colours of section 7.
  Vec color_at_ground(const Press& press, Vec ground_color) const {
    return press(mirrored + ((scattered + product(passed(), ground_color)) >> 15));
  }
  Vec color_at_background(const Press& press) const {
    const Vec light = press(mirrored + (scattered >> 15)) + (product(passed(), scene.look.background) >> 15);
    return {std::min<Int>(light.x, 4096), std::min<Int>(light.y, 4096), std::min<Int>(light.z, 4096)};
  }

 private:
  bool is_air(Int k) const { return scene.levels.sample(place_of_sample(ray, k)) < 0; }
  // Section 4 defines the part.
  Int part(Int a, Int n) const { return (length * a) >> n; }
  // Section 2 defines what has passed.
  Vec passed() const {
    Vec result;
    for (int channel = 0; channel < 3; ++channel)
      result.at(channel) =
          (left * scene.look.clear.passes(way >> 8, scene.look.clear.loss.at(channel))) >> 12;
    return result;
  }
  bool nothing_passes() const { return largest_magnitude(passed()) == 0; }
  void dim(Int lost) { left = (left * (4096 - lost)) >> 12; }
  void scatter(Vec before, Vec color) { scattered = scattered + product(before - passed(), color); }
  // Section 5 defines a crossing.
  void cross(Vec q, bool enters) {
    const Surface surface =
        surface_at(scene.look, scene.grid, scene.bytes, q, matter_normal(scene.levels, q));
    const Mirrored seen_in = mirrored_in(scene.look, surface, enters ? surface.n : -surface.n, e);
    mirrored = mirrored + (product(passed(), seen_in.shine) >> 15);
    dim(seen_in.more);
    const Vec before = passed();
    dim(mixed(scene.look.clear.frost, 4096, surface.w));
    scatter(before, body_of(surface));
  }
  // Goes the way d at the position of sample k (section 6).
  void go(Int d, Int k) {
    const Vec q = place_of_sample(ray, k);
    const Look& look = scene.look;
    const MatterBytes& bytes = scene.bytes;
    const LightBytes light = scene.grid.at(q);
    const auto [l, w] = shares_of(bytes.read(bytes.liquid, q), bytes.read(bytes.obstacle, q));
    const Vec before = passed();
    way = std::min<Int>(way + d, power_of_two(27) - 1);
    dim(w);
    const Vec solid = look.solid_of(bytes.read(bytes.heat, q)).diffuse;
    const Vec diffuse = mixed(mixed(solid, look.liquid.diffuse, l), look.obstacle.diffuse, w);
    const Int beside = light.open[0] + light.open[1] + light.open[4] + light.open[5];
    const Int above = ((2 * light.open[2] + beside) * 43) >> 9;
    const Int below = ((2 * light.open[3] + beside) * 43) >> 9;
    const Vec inner =
        ((look.from_above * above + look.from_below * below) >> 8) + ((look.lamp * whole(light.lamp)) >> 9);
    scatter(before, product(inner, diffuse) >> 12);
  }

  const ClearScene& scene;
  const Ray& ray;
  Int m;
  Vec e;
  Int length, left = 4096, way = 0;
  Vec mirrored, scattered;
};
