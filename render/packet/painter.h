// The painter finds what a ray sees, by render/rule alone. It gives the plain picture of any scene whose
// parts can be asked for.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "render/ground/watched_ground.h"
#include "render/packet/clear_painter.h"
#include "render/rule/camera.h"
#include "render/rule/crossing.h"
#include "render/rule/nearer.h"
#include "render/rule/normal.h"
#include "render/rule/shade.h"
#include "render/rule/tone.h"
#include "render/rule/watch.h"

namespace voxmelt::render {

// Holds a scene. Levels, Matter and Lights give the value of any of their cells.
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
  bool ground = false;
};

// Paints rays one by one. The watcher is told every number of a ray.
template <class Scene, class Watch = picture::Silent>
class Painter {
 public:
  Painter(const Scene& scene, const picture::View& view, int spacing, Watch watch = {})
      : scene_(scene), view_(view), spacing_(spacing), watch_(watch) {}

  // Returns the pressed light through a place of the picture.
  picture::Color light(std::int64_t across, std::int64_t down) const {
    const Met met(scene_, view_, across, down, spacing_, watch_);
    if (scene_.paint.clear) return clear_light(met);
    if (met.on_ground) return pressed(ground_color(met));
    if (met.matter.found) return pressed(matter_color(met));
    watch_(Stage::pixel, "background", scene_.background);
    return scene_.background;
  }
  // Returns the surface at a place of the picture.
  Seen seen(std::int64_t across, std::int64_t down) const {
    const Met met(scene_, view_, across, down, spacing_, watch_);
    if (met.on_ground)
      return {true, met.ground.position, ground_normal(met, paint_ground(scene_.ground, met.ground, watch_)),
              true};
    if (met.matter.found) return {true, met.matter.position, matter_normal(met)};
    return {};
  }
  // Returns the bytes of matter at a position.
  picture::Matter matter(picture::Vector position) const {
    return picture::matter_at(watched(scene_.matter, Stage::matter), scene_.cells, position, watch_);
  }

 private:
  using Stage = picture::Stage;
  template <class Cells>
  auto watched(const Cells& cells, Stage stage) const {
    return picture::Watched{cells, watch_, stage};
  }

  struct Met {
    Met(const Scene& scene, const picture::View& view, std::int64_t across, std::int64_t down, int spacing,
        Watch watch)
        : ray(picture::ray_through(view, across, down, spacing, watch)),
          matter(picture::first_crossing(picture::Watched{scene.levels, watch, Stage::sample}, scene.cells,
                                         ray, 0, watch)),
          ground(find_ground(scene.ground, ray, watch)),
          on_ground(picture::ground_first(ground, matter, view.halvings)) {
      if (!on_ground && !matter.found) return;
      const picture::Vector position = on_ground ? ground.position : matter.position;
      watch(Stage::met, "on ground", on_ground ? 1 : 0);
      watch(Stage::met, "depth", picture::depth_in_picture(view, position));
    }

    picture::Ray ray;
    picture::Crossing matter;
    picture::GroundCrossing ground;
    bool on_ground;
  };

  picture::Vector to_eye(const Met& met) const {
    const picture::Vector eye = picture::unit_of(picture::Vector{} - met.ray.step, watch_);
    watch_(Stage::met, "to_eye", eye);
    return eye;
  }
  picture::Color clear_light(const Met& met) const {
    ClearPainter<Scene, Watch> along(scene_, met.ray, met.ground, spacing_, view_.halvings, watch_);
    if (along.follow(met.matter)) return pressed(along.sum(ground_color(met)));
    const picture::Color share = along.passed();
    picture::Color light = pressed(along.sum({}));
    for (std::size_t c = 0; c < 3; ++c)
      light[c] =
          std::min(light[c] + ((share[c] * scene_.background[c]) >> picture::kPassedBits), picture::kLight);
    return light;
  }

  picture::Vector ground_normal(const Met& met, const GroundMap::Paint& paint) const {
    return met.ground.face == picture::Face::none ? to_eye(met) : paint.normal;
  }
  picture::Vector matter_normal(const Met& met) const {
    const picture::Vector normal =
        met.matter.sample == 0
            ? to_eye(met)
            : picture::normal_at(watched(scene_.levels, Stage::normal), met.matter.position, watch_);
    watch_(Stage::normal, "normal", normal);
    return normal;
  }

  picture::Color ground_color(const Met& met) const {
    const GroundMap::Paint paint = paint_ground(scene_.ground, met.ground, watch_);
    const picture::Vector normal = ground_normal(met, paint);
    const picture::Color color{static_cast<std::int32_t>(paint.color.x),
                               static_cast<std::int32_t>(paint.color.y),
                               static_cast<std::int32_t>(paint.color.z)};
    return picture::ground_color(scene_.paint, normal, light_before(met.ground.position, normal), color,
                                 watch_);
  }
  picture::Color matter_color(const Met& met) const {
    const picture::Vector normal = matter_normal(met), position = met.matter.position;
    picture::Matter made_of = matter(position);
    made_of.obstacle = matter(position + normal * (std::int64_t{1} << 5)).obstacle;
    const picture::Light light = light_before(position, normal);
    return picture::matter_color(scene_.paint, normal, to_eye(met), light, made_of, watch_);
  }
  picture::Light light_before(picture::Vector position, picture::Vector normal) const {
    return picture::light_at(watched(scene_.light, Stage::light), scene_.light_count, scene_.light_shift,
                             picture::before_surface(position, normal, scene_.light_shift), watch_);
  }
  picture::Color pressed(picture::Color color) const {
    for (std::int32_t& c : color) c = scene_.tone[std::clamp(c, 0, picture::kBrightest)];
    watch_(Stage::pixel, "pressed", color);
    return color;
  }

  const Scene& scene_;
  const picture::View view_;
  const int spacing_;
  const Watch watch_;
};

}  // namespace voxmelt::render
