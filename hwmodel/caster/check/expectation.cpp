#include "hwmodel/caster/check/expectation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "hwmodel/caster/host/keep.h"
#include "render/ground/watched_ground.h"
#include "render/packet/tables.h"
#include "render/rule/crossing.h"
#include "render/rule/ground.h"
#include "render/rule/nearer.h"
#include "render/rule/normal.h"
#include "render/rule/shade.h"

namespace voxmelt::hwmodel::raycast {
Expectation::Expectation(const render::PictureScene& scene, const picture::Camera& camera,
                         render::Setting setting)
    : scene_(scene),
      view_(picture::view_of(camera, scene.levels.cells())),
      spacing_(render::spacing_of(setting, view_)) {
  const picture::Vector cells = scene.levels.cells();
  row_ = cells.x + 1;
  slice_ = row_ * (cells.y + 1);
  air_.assign(slice_ * (cells.z + 1), 255);
  for (std::int64_t z = 0; z < cells.z; ++z)
    for (std::int64_t y = 0; y < cells.y; ++y)
      for (std::int64_t x = 0; x < cells.x; ++x) {
        if (scene.levels(x, y, z) < 0) continue;
        const std::size_t i = z * slice_ + y * row_ + x;
        for (const std::size_t more : {std::size_t{0}, slice_})
          for (const std::size_t beside : {std::size_t{0}, row_})
            air_[i + more + beside] = air_[i + more + beside + 1] = 0;
      }
  measure_air();
}

// Takes the largest of three distances: one axis after the other, each there and back.
void Expectation::measure_air() {
  const std::size_t rows = slice_ / row_, slices = air_.size() / slice_;
  const auto along = [&](std::size_t stride, std::size_t count, std::size_t from) {
    // Cell i of a line becomes the least max(its value, distance) of the line.
    std::vector<std::uint8_t> line(count);
    for (std::size_t i = 0; i < count; ++i) line[i] = air_[from + i * stride];
    for (std::size_t i = 0; i < count; ++i) {
      std::uint8_t least = line[i];
      for (std::size_t d = 1; d < least && (d <= i || i + d < count); ++d) {
        const std::uint8_t before = d <= i ? line[i - d] : 255, after = i + d < count ? line[i + d] : 255;
        least = std::min(least, std::max({std::min(before, after), static_cast<std::uint8_t>(d)}));
      }
      air_[from + i * stride] = least;
    }
  };
  for (std::size_t z = 0; z < slices; ++z)
    for (std::size_t y = 0; y < rows; ++y) along(1, row_, z * slice_ + y * row_);
  for (std::size_t z = 0; z < slices; ++z)
    for (std::size_t x = 0; x < row_; ++x) along(row_, rows, z * slice_ + x);
  for (std::size_t i = 0; i < slice_; ++i) along(slice_, slices, i);
}

// Returns the crossing of the rule, which looks at every sample. The samples that are left out here have air
// around them.
picture::Crossing Expectation::first_crossing(const picture::Ray& ray) const {
  const picture::Samples in =
      picture::samples_in(ray, picture::field_low(), picture::field_high(scene_.levels.cells()));
  // From one sample to the next, a ray moves no farther than this along any axis.
  const std::int64_t farthest =
      std::max({std::abs(ray.step.x), std::abs(ray.step.y), std::abs(ray.step.z), std::int64_t{1}});
  std::int64_t steps = 0;
  for (std::int64_t k = in.first; k <= in.last; k += steps) {
    const picture::Vector at = ray.at(k);
    steps = 1;
    const auto lower = [](std::int64_t p) {
      return static_cast<std::size_t>(((p + picture::kToPlace) >> picture::kPositionBits) + 1);
    };
    if (const std::int64_t air = air_[lower(at.z) * slice_ + lower(at.y) * row_ + lower(at.x)]; air > 0) {
      steps = std::max<std::int64_t>(1, (air - 1) * picture::kCell / farthest);
      continue;
    }
    if (sample(at) < 0) continue;
    return k == 0 ? picture::Crossing{true, 0, picture::kPlaces, ray.start}
                  : picture::crossing_before(scene_.levels, ray, k);
  }
  return {};
}

ExpectedRay Expectation::ray(std::int64_t across, std::int64_t down) const {
  ExpectedRay ray;
  ray.ray = picture::ray_through(view_, across, down, spacing_);
  ray.matter = first_crossing(ray.ray);
  ray.ground = scene_.ground.find(ray.ray);
  return ray;
}

std::int32_t Expectation::sample(picture::Vector position) const {
  return picture::sample(scene_.levels, position);
}

std::int64_t Expectation::above_ground(picture::Vector position) const {
  return picture::above_ground(render::columns_of(scene_.ground, scene_.ground.drawn()),
                               scene_.ground.cells(), position);
}

void Expectation::shade(ExpectedRay& ray) const {
  ray.shaded = true;
  if (scene_.paint.clear) return follow(ray);
  Surface& to = ray.surface;
  if (picture::ground_first(ray.ground, ray.matter, view_.halvings)) {
    shade_ground(ray);
  } else if (ray.matter.found) {
    shade_matter(ray);
  } else {
    to.sum = ray.pressed = scene_.look.background;
    return;
  }
  ray.pressed = pressed(to.sum);
}

void Expectation::meet(ExpectedRay& ray, picture::Vector position) const {
  Surface& to = ray.surface;
  to.position = vec_of(position);
  to.face = static_cast<Face>(ray.ground.face);
  to.depth = picture::depth_in_picture(view_, position);
  to.to_eye = vec_of(picture::unit_of(picture::Vector{} - ray.ray.step));
}

picture::Light Expectation::light_before(picture::Vector position, picture::Vector normal) const {
  return picture::light_at(scene_.light, scene_.light.count(), scene_.light.shift(),
                           picture::before_surface(position, normal, scene_.light.shift()));
}

void Expectation::shade_ground(ExpectedRay& ray) const {
  Surface& to = ray.surface;
  const picture::Vector position = ray.ground.position;
  to.kind = Surface::Kind::ground;
  to.inside = ray.ground.face == picture::Face::none;
  meet(ray, position);
  const picture::Vector to_eye = vector_of(to.to_eye);
  // This normal is the one before the texture of rock.
  ray.ground_normal = to_eye;
  const auto columns = render::columns_of(scene_.ground, scene_.ground.bare());
  if (!to.inside)
    ray.ground_normal = picture::ground_normal(columns, scene_.ground.cells(), position, ray.ground.face);
  const render::GroundMap::Paint paint = scene_.ground.paint(ray.ground);
  const picture::Vector normal = to.inside ? to_eye : paint.normal;
  const picture::Color color{static_cast<std::int32_t>(paint.color.x),
                             static_cast<std::int32_t>(paint.color.y),
                             static_cast<std::int32_t>(paint.color.z)};
  to.color = color;
  to.normal = vec_of(normal);
  const picture::Light light = light_before(position, normal);
  to.light = {light.lamp, light.open, light.glow};
  to.sum = picture::ground_color(scene_.paint, normal, light, color, Keep{to});
}

void Expectation::shade_matter(ExpectedRay& ray) const {
  Surface& to = ray.surface;
  const picture::Vector position = ray.matter.position;
  to.kind = Surface::Kind::matter;
  to.inside = ray.matter.sample == 0;
  meet(ray, position);
  const picture::Vector to_eye = vector_of(to.to_eye);
  const picture::Vector normal = to.inside ? to_eye : picture::normal_at(scene_.levels, position);
  to.normal = vec_of(normal);
  const picture::Light light = light_before(position, normal);
  to.light = {light.lamp, light.open, light.glow};
  const auto matter_at = [&](picture::Vector p) {
    return picture::matter_at(scene_.matter, scene_.levels.cells(), p);
  };
  picture::Matter matter = matter_at(position);
  matter.obstacle = matter_at(position + normal * 32).obstacle;
  to.matter = {matter.liquid, matter.heat, matter.obstacle};
  to.sum = picture::matter_color(scene_.paint, normal, to_eye, light, matter, Keep{to});
}

Rgb Expectation::pressed(const Rgb& sum) {
  Rgb color{};
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = render::tone_table()[std::clamp(sum[c], 0, picture::kBrightest)];
  return color;
}

}  // namespace voxmelt::hwmodel::raycast
