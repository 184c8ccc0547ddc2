#include "hwmodel/picture/expectation.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <type_traits>

#include "render/ground/watched_ground.h"
#include "render/packet/tables.h"
#include "render/rule/crossing.h"
#include "render/rule/nearer.h"
#include "render/rule/normal.h"
#include "render/rule/shade.h"
#include "render/rule/watch.h"

namespace voxmelt::hwmodel::raycast {
namespace {

Vec vec_of(picture::Vector v) { return {v.x, v.y, v.z}; }

// Keeps what the rule tells of a surface.
struct Keep {
  Surface& to;

  template <class Value>
  [[gnu::always_inline]] void operator()(picture::Stage stage, std::string_view name,
                                         const Value& value) const {
    using picture::Stage;
    if constexpr (std::is_same_v<Value, picture::Color>) {
      if (stage == Stage::material && name == "diffuse") to.mixture.material.diffuse = value;
      if (stage == Stage::material && name == "mirror") to.mixture.material.mirror = value;
      if (stage == Stage::material && name == "highlight") to.mixture.material.highlight = value;
      if (stage == Stage::material && name == "emission") to.mixture.emission = value;
      if (stage == Stage::arriving && name == "arriving") to.arriving.light = value;
      if (stage == Stage::mirror && name == "around") to.mirrored.around = value;
      if (stage == Stage::colour && name == "colour") to.sum = value;
    } else if constexpr (std::is_same_v<Value, picture::Vector>) {
      if (stage == Stage::mirror && name == "r") to.mirrored.reflected = vec_of(value);
    } else if constexpr (std::is_integral_v<Value>) {
      const auto narrow = static_cast<std::int32_t>(value);
      if (stage == Stage::material && name == "l") to.mixture.l = narrow;
      if (stage == Stage::material && name == "w") to.mixture.w = narrow;
      if (stage == Stage::material && name == "gloss") to.mixture.material.gloss = narrow;
      if (stage == Stage::arriving && name == "lamp") to.arriving.lamp = value;
      if (stage == Stage::arriving && name == "facing") to.arriving.facing = value;
      if (stage == Stage::arriving && name == "lit") to.arriving.lit = value;
      if (stage == Stage::mirror && name == "peak") to.mirrored.peak = value;
      if (stage == Stage::mirror && name == "eye") to.mirrored.eye = value;
      if (stage == Stage::mirror && name == "more") to.mirrored.more = value;
      if (stage == Stage::mirror && name == "free") to.mirrored.free = value;
    }
  }
};

}  // namespace

Expectation::Expectation(const render::PictureScene& scene, const picture::Camera& camera,
                         render::Setting setting)
    : scene_(scene),
      view_(picture::view_of(camera, scene.levels.cells())),
      spacing_(render::spacing_of(setting, view_)) {
  const picture::Vector cells = scene.levels.cells();
  row_ = static_cast<std::size_t>(cells.x + 1), slice_ = row_ * static_cast<std::size_t>(cells.y + 1);
  near_matter_.assign(slice_ * static_cast<std::size_t>(cells.z + 1), 0);
  for (std::int64_t z = 0; z < cells.z; ++z)
    for (std::int64_t y = 0; y < cells.y; ++y)
      for (std::int64_t x = 0; x < cells.x; ++x) {
        if (scene.levels(x, y, z) < 0) continue;
        const std::size_t i = static_cast<std::size_t>(z) * slice_ + static_cast<std::size_t>(y) * row_ +
                              static_cast<std::size_t>(x);
        for (const std::size_t more : {std::size_t{0}, slice_})
          for (const std::size_t beside : {std::size_t{0}, row_})
            near_matter_[i + more + beside] = near_matter_[i + more + beside + 1] = 1;
      }
}

// That of the rule, which looks at every sample.
picture::Crossing Expectation::first_crossing(const picture::Ray& ray) const {
  const picture::Samples in =
      picture::samples_in(ray, picture::field_low(), picture::field_high(scene_.levels.cells()));
  picture::Vector at = ray.at(in.first);
  for (std::int64_t k = in.first; k <= in.last; ++k, at = at + ray.step) {
    const auto lower = [](std::int64_t p) {
      return static_cast<std::size_t>(((p + picture::kToPlace) >> picture::kPositionBits) + 1);
    };
    if (near_matter_[lower(at.z) * slice_ + lower(at.y) * row_ + lower(at.x)] == 0) continue;
    if (sample(at) < 0) continue;
    return k == 0 ? picture::Crossing{true, 0, picture::kPlaces, ray.start}
                  : picture::crossing_before(scene_.levels, ray, k);
  }
  return {};
}

ExpectedRay Expectation::ray(std::int64_t across, std::int64_t down) const {
  ExpectedRay of;
  of.ray = picture::ray_through(view_, across, down, spacing_);
  of.matter = first_crossing(of.ray);
  of.ground = scene_.ground.find(of.ray);
  return of;
}

std::int32_t Expectation::sample(picture::Vector position) const {
  return picture::sample(scene_.levels, position);
}

void Expectation::shade(ExpectedRay& ray) const {
  using Kind = Surface::Kind;
  ray.shaded = true;
  Surface& to = ray.surface;
  const bool on_ground = picture::ground_first(ray.ground, ray.matter, view_.halvings);
  if (!on_ground && !ray.matter.found) {
    to.sum = ray.pressed = scene_.look.background;
    return;
  }
  to.kind = on_ground ? Kind::ground : Kind::matter;
  const picture::Vector position = on_ground ? ray.ground.position : ray.matter.position;
  to.position = vec_of(position);
  to.face = static_cast<Face>(ray.ground.face);
  to.inside = on_ground ? ray.ground.face == picture::Face::none : ray.matter.sample == 0;
  to.depth = picture::depth_in_picture(view_, position);
  const picture::Vector to_eye = picture::unit_of(picture::Vector{} - ray.ray.step);
  to.to_eye = vec_of(to_eye);

  picture::Vector normal;
  picture::Color color{};
  if (on_ground) {
    // Before the texture of rock, too.
    ray.ground_normal = to_eye;
    const auto columns = render::columns_of(scene_.ground, scene_.ground.bare());
    if (!to.inside)
      ray.ground_normal = picture::ground_normal(columns, scene_.ground.cells(), position, ray.ground.face);
    const render::GroundMap::Paint paint = scene_.ground.paint(ray.ground);
    normal = to.inside ? to_eye : paint.normal;
    color = {static_cast<std::int32_t>(paint.color.x), static_cast<std::int32_t>(paint.color.y),
             static_cast<std::int32_t>(paint.color.z)};
    to.color = color;
  } else {
    normal = to.inside ? to_eye : picture::normal_at(scene_.levels, position);
  }
  to.normal = vec_of(normal);
  const picture::Light light =
      picture::light_at(scene_.light, scene_.light.count(), scene_.light.shift(),
                        picture::before_surface(position, normal, scene_.light.shift()));
  to.light = {light.lamp, light.open, light.glow};
  picture::Color sum;
  if (on_ground) {
    sum = picture::ground_color(scene_.paint, normal, light, color, Keep{to});
  } else {
    const auto matter_at = [&](picture::Vector p) {
      return picture::matter_at(scene_.matter, scene_.levels.cells(), p);
    };
    picture::Matter matter = matter_at(position);
    matter.obstacle = matter_at(position + normal * 32).obstacle;
    to.matter = {matter.liquid, matter.heat, matter.obstacle};
    sum = picture::matter_color(scene_.paint, normal, to_eye, light, matter, Keep{to});
  }
  for (std::size_t c = 0; c < 3; ++c)
    ray.pressed[c] =
        render::tone_table()[static_cast<std::size_t>(std::clamp(sum[c], 0, picture::kBrightest))];
}

}  // namespace voxmelt::hwmodel::raycast
