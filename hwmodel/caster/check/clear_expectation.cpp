// A ray through clear matter is expected to go as the reference follows it (render/packet/clear_painter.h).
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "hwmodel/caster/check/expectation.h"
#include "hwmodel/caster/host/keep.h"
#include "render/packet/clear_painter.h"
#include "render/packet/painter.h"
#include "render/packet/tables.h"
#include "render/rule/clear.h"
#include "render/rule/watch.h"

namespace voxmelt::hwmodel::raycast {
namespace {

// Collects what has been told of a ray so far.
struct Told {
  ExpectedClear& to;
  picture::Crossing crossing{};  // present one
  bool leaves = false;           // the present crossing leaves matter
  Vec to_eye{};
  int matters = 0;  // times that the present event has read matter
};

// A crossing begins with "samples" and ends with its position. An event begins with "enters" or with "d", and
// ends with the sums of the ray.
struct KeepEvents {
  Told* told;

  template <class Value>
  void operator()(picture::Stage stage, std::string_view name, const Value& value) const {
    using picture::Stage;
    if (stage == Stage::crossing)
      take_crossing(name, value);
    else if (stage == Stage::clear)
      take_clear(name, value);
    else
      take_surface(stage, name, value);
  }

 private:
  using Kind = Surface::Kind;
  Surface& event() const { return told->to.events.back(); }

  template <class Value>
  void take_crossing(std::string_view name, const Value& value) const {
    picture::Crossing& crossing = told->crossing;
    if constexpr (std::is_same_v<Value, std::array<std::int64_t, 2>>) {
      if (name == "samples") told->leaves = value[0] > value[1];
    } else if constexpr (std::is_integral_v<Value>) {
      if (name == "sample") crossing.sample = value;
      if (name == "part") crossing.part = static_cast<std::int32_t>(value);
    } else if constexpr (std::is_same_v<Value, picture::Vector>) {
      if (name != "crossing") return;
      crossing.position = value;
      crossing.found = true;
      (told->leaves ? told->to.exits : told->to.entries).push_back(crossing);
    }
  }

  void begin(Kind kind) const {
    told->matters = 0;
    Surface& surface = told->to.events.emplace_back();
    surface.kind = kind;
    surface.to_eye = told->to_eye;
    surface.clear.event = static_cast<std::int32_t>(told->to.events.size()) - 1;
  }
  template <class Value>
  void take_clear(std::string_view name, const Value& value) const {
    Passage& sums = told->to.passage;
    if constexpr (std::is_same_v<Value, picture::Color>) {
      if (name == "gleam") event().clear.gleam = value;
      if (name == "inner") event().arriving.light = value;
      if (name == "body") event().sum = value;
      if (name == "passed") sums.passed = value;
      if (name == "mirrored") sums.mirrored = value;
      if (name == "scattered") sums.scattered = value;
    } else if constexpr (std::is_same_v<Value, picture::Vector>) {
      if (name == "position") event().position = vec_of(value);
    } else if constexpr (std::is_integral_v<Value>) {
      if (name == "enters") {
        begin(Kind::matter);
        event().clear.leaves = value == 0;
      }
      if (name == "d") {
        begin(Kind::way);
        event().clear.way = static_cast<std::int32_t>(value);
      }
      if (name == "left") sums.left.surfaces = value;
      if (name == "way") sums.left.way = value;
    }
  }

  template <class Value>
  void take_surface(picture::Stage stage, std::string_view name, const Value& value) const {
    using picture::Stage;
    if constexpr (std::is_same_v<Value, picture::Vector>)
      if (stage == Stage::met && name == "to_eye") told->to_eye = vec_of(value);
    if (told->to.events.empty()) return;
    Surface& to = event();
    Keep{to}(stage, name, value);
    if constexpr (std::is_same_v<Value, picture::Vector>) {
      if (stage == Stage::normal && name == "normal") to.normal = vec_of(value);
      if (stage == Stage::matter && name == "position") ++told->matters;
    } else if constexpr (std::is_same_v<Value, std::array<std::int32_t, picture::kSides>>) {
      if (stage == Stage::light && name == "open") to.light.open = value;
      if (stage == Stage::light && name == "glow") to.light.glow = value;
    } else if constexpr (std::is_integral_v<Value>) {
      const auto narrow = static_cast<std::int32_t>(value);
      if (stage == Stage::light && name == "lamp") to.light.lamp = narrow;
      if (stage == Stage::matter && name == "obstacle") to.matter.obstacle = narrow;  // the last one counts
      if (told->matters > 1) return;
      if (stage == Stage::matter && name == "liquid") to.matter.liquid = narrow;
      if (stage == Stage::matter && name == "heat") to.matter.heat = narrow;
    }
  }
};

}  // namespace

void Expectation::follow(ExpectedRay& ray) const {
  using Scene = render::PaintedScene<render::Levels, render::MatterCells, render::LightVolume>;
  const Scene parts{scene_.levels,          scene_.levels.cells(), scene_.matter,        scene_.ground,
                    scene_.light,           scene_.light.count(),  scene_.light.shift(), scene_.paint,
                    scene_.look.background, render::tone_table()};
  Told told{ray.clear};
  if (ray.matter.found) ray.clear.entries.push_back(ray.matter);
  render::ClearPainter<Scene, KeepEvents> along(parts, ray.ray, ray.ground, spacing_, view_.halvings,
                                                KeepEvents{&told});
  const bool arrives = along.follow(ray.matter);
  ray.clear.dark = along.dark();
  if (arrives) {
    shade_ground(ray);
    ray.pressed = pressed(along.sum(ray.surface.sum));
    return;
  }
  ray.surface.to_eye = told.to_eye;
  ray.surface.sum = scene_.look.background;
  ray.pressed = pressed(along.sum({}));
  const picture::Color passes = along.passed();
  for (std::size_t c = 0; c < 3; ++c)
    ray.pressed[c] = std::min(
        ray.pressed[c] + ((passes[c] * scene_.look.background[c]) >> picture::kPassedBits), picture::kLight);
}

}  // namespace voxmelt::hwmodel::raycast
