#include "render/raycast/reference_picture.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "render/rule/antialias.h"
#include "render/rule/crossing.h"
#include "render/rule/nearer.h"
#include "render/rule/normal.h"
#include "render/rule/tone.h"

namespace voxmelt::render {
namespace {

using picture::Color;

const picture::Tone kTone = picture::tone_table();
const picture::Bytes kBytes = picture::byte_table();

class Painter {
 public:
  Painter(const PictureScene& scene, const picture::Camera& camera, int spacing)
      : scene_(scene), view_(picture::view_of(camera, scene.levels.cells())), spacing_(spacing) {}

  // Through a place of the picture: pressed light.
  Color light(std::int64_t across, std::int64_t down) const {
    const picture::Ray ray = picture::ray_through(view_, across, down, spacing_);
    const picture::Crossing matter = picture::first_crossing(scene_.levels, scene_.levels.cells(), ray);
    const picture::GroundCrossing ground = scene_.ground.find(ray);
    if (picture::ground_first(ground, matter)) return pressed(ground_color(ray, ground));
    if (matter.found) return pressed(matter_color(ray, matter));
    return scene_.look.background;
  }

 private:
  Color ground_color(const picture::Ray& ray, const picture::GroundCrossing& crossing) const {
    const GroundMap::Paint paint = scene_.ground.paint(crossing);
    const picture::Vector normal = crossing.face == picture::Face::none ? to_eye(ray) : paint.normal;
    const Color color{static_cast<std::int32_t>(paint.color.x), static_cast<std::int32_t>(paint.color.y),
                      static_cast<std::int32_t>(paint.color.z)};
    return picture::ground_color(scene_.paint, normal, light_before(crossing.position, normal), color);
  }
  Color matter_color(const picture::Ray& ray, const picture::Crossing& crossing) const {
    const picture::Vector eye = to_eye(ray);
    const picture::Vector normal = crossing.sample == 0 ? eye : picture::normal_at(scene_.levels, crossing.position);
    picture::Matter matter = picture::matter_at(scene_.matter, crossing.position);
    matter.obstacle =
        picture::matter_at(scene_.matter, crossing.position + normal * (std::int64_t{1} << 5)).obstacle;
    return picture::matter_color(scene_.paint, normal, eye, light_before(crossing.position, normal), matter);
  }
  picture::Light light_before(picture::Vector position, picture::Vector normal) const {
    return picture::light_at(scene_.light, scene_.light.count(), scene_.light.shift(),
                             picture::before_surface(position, normal, scene_.light.shift()));
  }
  static picture::Vector to_eye(const picture::Ray& ray) { return picture::unit_of(picture::Vector{} - ray.step); }
  static Color pressed(Color color) {
    for (std::int32_t& c : color)
      c = kTone[static_cast<std::size_t>(std::clamp(c, 0, picture::kBrightest))];
    return color;
  }

  const PictureScene& scene_;
  const picture::View view_;
  const int spacing_;
};

Rgb bytes(const Color& light) {
  const auto byte = [&](std::size_t c) { return kBytes[static_cast<std::size_t>(light[c])]; };
  return {byte(0), byte(1), byte(2)};
}

}  // namespace

Image reference_picture(const PictureScene& scene, const picture::Camera& camera, Setting setting) {
  const Painter painter(scene, camera, setting == Setting::best ? 3 : 2);
  Image image(static_cast<int>(camera.width), static_cast<int>(camera.height));
  const auto draw = [&](Image& to, int x, int y, const auto& pattern) {
    Color sum{};
    for (const picture::Sub& sub : pattern) {
      const Color one = painter.light(x * picture::kPixel + sub.across, y * picture::kPixel + sub.down);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += one[c];
    }
    const auto count = static_cast<std::int32_t>(pattern.size());
    for (std::int32_t& c : sum) c = (c + count / 2) / count;
    to.at(x, y) = bytes(sum);
  };
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) draw(image, x, y, picture::kMiddle);
  if (setting == Setting::fast) return image;

  // Pixels that differ from a neighbour, as drawn so far.
  const auto refine = [&](int difference, const auto& pattern) {
    const Image before = image;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        bool differs = false;
        const auto look = [&](int nx, int ny) {
          if (nx < 0 || ny < 0 || nx >= image.width || ny >= image.height) return;
          differs |= picture::differ(before.at(x, y), before.at(nx, ny), difference);
        };
        look(x - 1, y), look(x + 1, y), look(x, y - 1), look(x, y + 1);
        if (differs) draw(image, x, y, pattern);
      }
  };
  refine(picture::kDifference, picture::kFour);
  if (setting == Setting::best) refine(picture::kFineDifference, picture::kSixteen);
  return image;
}

}  // namespace voxmelt::render
