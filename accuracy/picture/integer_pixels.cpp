#include "accuracy/picture/integer_pixels.h"

#include <algorithm>
#include <cstddef>

#include "render/rule/nearer.h"
#include "render/rule/normal.h"
#include "render/rule/tone.h"

namespace voxmelt::accuracy {
namespace {

const picture::Tone kTone = picture::tone_table();
const picture::Bytes kBytes = picture::byte_table();

}  // namespace

IntegerPixels::IntegerPixels(const render::PictureScene& scene, const ExactField& field,
                             const picture::Camera& camera, int spacing)
    : scene_(scene),
      field_(field),
      view_(picture::view_of(camera, scene.levels.cells())),
      spacing_(spacing + view_.halvings) {}

picture::Crossing IntegerPixels::first_crossing(const picture::Ray& ray) const {
  const picture::Samples in =
      picture::samples_in(ray, picture::field_low(), picture::field_high(scene_.levels.cells()));
  for (std::int64_t k = in.first; k <= in.last;) {
    const picture::Vector p = ray.at(k);
    const int far = field_.distance(picture::place_of(p.x).cell, picture::place_of(p.y).cell,
                                    picture::place_of(p.z).cell);
    // The steps of far - 1 cells are skipped: they end in the last cell of air at most.
    if (far > 0) {
      k += std::max(std::int64_t{1}, std::int64_t{far - 1} << spacing_);
      continue;
    }
    if (picture::sample(scene_.levels, p) >= 0)
      return k == 0 ? picture::Crossing{true, 0, picture::kPlaces, ray.start}
                    : picture::crossing_before(scene_.levels, ray, k);
    ++k;
  }
  return {};
}

picture::Color IntegerPixels::light(std::int64_t across, std::int64_t down) const {
  const picture::Ray ray = picture::ray_through(view_, across, down, spacing_);
  const picture::Crossing matter = first_crossing(ray);
  const picture::GroundCrossing ground = scene_.ground.find(ray);
  const picture::Vector to_eye = picture::unit_of(picture::Vector{} - ray.step);
  const auto light_before = [&](picture::Vector position, picture::Vector normal) {
    return picture::light_at(scene_.light, scene_.light.count(), scene_.light.shift(),
                             picture::before_surface(position, normal, scene_.light.shift()));
  };
  picture::Color color = scene_.look.background;
  if (picture::ground_first(ground, matter, view_.halvings)) {
    const render::GroundMap::Paint paint = scene_.ground.paint(ground);
    const picture::Vector normal = ground.face == picture::Face::none ? to_eye : paint.normal;
    color = picture::ground_color(
        scene_.paint, normal, light_before(ground.position, normal),
        {static_cast<std::int32_t>(paint.color.x), static_cast<std::int32_t>(paint.color.y),
         static_cast<std::int32_t>(paint.color.z)});
  } else if (matter.found) {
    const picture::Vector normal =
        matter.sample == 0 ? to_eye : picture::normal_at(scene_.levels, matter.position);
    const auto matter_at = [&](picture::Vector p) {
      return picture::matter_at(scene_.matter, scene_.levels.cells(), p);
    };
    picture::Matter the_matter = matter_at(matter.position);
    the_matter.obstacle = matter_at(matter.position + normal * 32).obstacle;
    color = picture::matter_color(scene_.paint, normal, to_eye, light_before(matter.position, normal),
                                  the_matter);
  } else {
    return color;
  }
  for (std::int32_t& c : color) c = kTone[std::clamp(c, 0, picture::kBrightest)];
  return color;
}

render::Rgb IntegerPixels::pixel(int x, int y, std::span<const picture::Sub> samples) const {
  picture::Color sum{};
  for (const picture::Sub& sub : samples) {
    const picture::Color one = light(x * picture::kPixel + sub.across, y * picture::kPixel + sub.down);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += one[c];
  }
  const auto count = static_cast<std::int32_t>(samples.size());
  render::Rgb bytes{};
  for (std::size_t c = 0; c < 3; ++c) bytes[c] = kBytes[(sum[c] + count / 2) / count];
  return bytes;
}

}  // namespace voxmelt::accuracy
