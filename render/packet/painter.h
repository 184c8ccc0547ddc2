// What a ray sees, by render/rule alone: the plain picture of any scene whose parts can be asked for.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "render/ground/ground_map.h"
#include "render/packet/clear_painter.h"
#include "render/rule/camera.h"
#include "render/rule/crossing.h"
#include "render/rule/nearer.h"
#include "render/rule/normal.h"
#include "render/rule/shade.h"
#include "render/rule/tone.h"

namespace voxmelt::render {

// Levels, Matter and Lights give the value of any cell of theirs.
template <class Levels, class Matter, class Lights>
struct PaintedScene {
  const Levels& levels;
  picture::Vector cells;
  const Matter& matter;
  const GroundMap& ground;
  const Lights& light;
  picture::Vector light_count;
  int light_shift;
  const picture::Paint& paint;
  const picture::Color& background;
  const picture::Tone& tone;
};

struct Seen {
  bool found = false;
  picture::Vector position, normal;
};

template <class Scene>
class Painter {
 public:
  Painter(const Scene& scene, const picture::View& view, int spacing)
      : scene_(scene), view_(view), spacing_(spacing) {}

  // Through a place of the picture: pressed light.
  picture::Color light(std::int64_t across, std::int64_t down) const {
    const Met met(scene_, view_, across, down, spacing_);
    if (scene_.paint.clear) return clear_light(met);
    if (met.on_ground) return pressed(ground_color(met));
    if (met.matter.found) return pressed(matter_color(met));
    return scene_.background;
  }
  // The surface there.
  Seen seen(std::int64_t across, std::int64_t down) const {
    const Met met(scene_, view_, across, down, spacing_);
    if (met.on_ground)
      return {true, met.ground.position, ground_normal(met, scene_.ground.paint(met.ground))};
    if (met.matter.found) return {true, met.matter.position, matter_normal(met)};
    return {};
  }

 private:
  struct Met {
    Met(const Scene& scene, const picture::View& view, std::int64_t across, std::int64_t down, int spacing)
        : ray(picture::ray_through(view, across, down, spacing)),
          matter(picture::first_crossing(scene.levels, scene.cells, ray)),
          ground(scene.ground.find(ray)),
          on_ground(picture::ground_first(ground, matter)) {}
    picture::Vector to_eye() const { return picture::unit_of(picture::Vector{} - ray.step); }

    picture::Ray ray;
    picture::Crossing matter;
    picture::GroundCrossing ground;
    bool on_ground;
  };

  picture::Color clear_light(const Met& met) const {
    ClearPainter<Scene> along(scene_, met.ray, met.ground, spacing_);
    if (along.follow(met.matter)) return pressed(along.sum(ground_color(met)));
    const picture::Color share = along.passed();
    picture::Color light = pressed(along.sum({}));
    for (std::size_t c = 0; c < 3; ++c)
      light[c] =
          std::min(light[c] + ((share[c] * scene_.background[c]) >> picture::kPassedBits), picture::kLight);
    return light;
  }

  static picture::Vector ground_normal(const Met& met, const GroundMap::Paint& paint) {
    return met.ground.face == picture::Face::none ? met.to_eye() : paint.normal;
  }
  picture::Vector matter_normal(const Met& met) const {
    return met.matter.sample == 0 ? met.to_eye() : picture::normal_at(scene_.levels, met.matter.position);
  }

  picture::Color ground_color(const Met& met) const {
    const GroundMap::Paint paint = scene_.ground.paint(met.ground);
    const picture::Vector normal = ground_normal(met, paint);
    const picture::Color color{static_cast<std::int32_t>(paint.color.x),
                               static_cast<std::int32_t>(paint.color.y),
                               static_cast<std::int32_t>(paint.color.z)};
    return picture::ground_color(scene_.paint, normal, light_before(met.ground.position, normal), color);
  }
  picture::Color matter_color(const Met& met) const {
    const picture::Vector normal = matter_normal(met), position = met.matter.position;
    const auto matter_at = [&](picture::Vector p) {
      return picture::matter_at(scene_.matter, scene_.cells, p);
    };
    picture::Matter matter = matter_at(position);
    matter.obstacle = matter_at(position + normal * (std::int64_t{1} << 5)).obstacle;
    return picture::matter_color(scene_.paint, normal, met.to_eye(), light_before(position, normal), matter);
  }
  picture::Light light_before(picture::Vector position, picture::Vector normal) const {
    return picture::light_at(scene_.light, scene_.light_count, scene_.light_shift,
                             picture::before_surface(position, normal, scene_.light_shift));
  }
  picture::Color pressed(picture::Color color) const {
    for (std::int32_t& c : color)
      c = scene_.tone[static_cast<std::size_t>(std::clamp(c, 0, picture::kBrightest))];
    return color;
  }

  const Scene& scene_;
  const picture::View view_;
  const int spacing_;
};

}  // namespace voxmelt::render
