#include "render/reference/reference_picture.h"

#include <cstddef>
#include <cstdint>

#include "render/packet/painter.h"
#include "render/packet/tables.h"
#include "render/rule/antialias.h"

namespace voxmelt::render {
namespace {

using picture::Color;

Rgb bytes(const Color& light) {
  const auto byte = [&](std::size_t c) { return byte_table()[static_cast<std::size_t>(light[c])]; };
  return {byte(0), byte(1), byte(2)};
}

PaintedScene<Levels, MatterCells, LightVolume> painted(const PictureScene& scene) {
  return {scene.levels,        scene.levels.cells(), scene.matter, scene.ground,          scene.light,
          scene.light.count(), scene.light.shift(),  scene.paint,  scene.look.background, tone_table()};
}

}  // namespace

SurfacePicture reference_surface(const PictureScene& scene, const picture::Camera& camera, Setting setting) {
  const auto parts = painted(scene);
  const picture::View view = picture::view_of(camera, scene.levels.cells());
  const Painter painter(parts, view, spacing_of(setting, view));
  SurfacePicture surface{static_cast<int>(camera.width), static_cast<int>(camera.height), {}, {}};
  for (std::int64_t y = 0; y < camera.height; ++y)
    for (std::int64_t x = 0; x < camera.width; ++x) {
      const Seen seen = painter.seen(x * picture::kPixel + picture::kMiddle[0].across,
                                     y * picture::kPixel + picture::kMiddle[0].down);
      const std::int64_t depth =
          seen.found ? picture::depth_in_picture(view, seen.position) : picture::kNoDepth;
      surface.depth.push_back(static_cast<std::uint16_t>(depth));
      surface.normal.push_back({static_cast<std::int16_t>(seen.normal.x),
                                static_cast<std::int16_t>(seen.normal.y),
                                static_cast<std::int16_t>(seen.normal.z)});
    }
  return surface;
}

Image reference_picture(const PictureScene& scene, const picture::Camera& camera, Setting setting) {
  const auto parts = painted(scene);
  const picture::View view = picture::view_of(camera, scene.levels.cells());
  const Painter painter(parts, view, spacing_of(setting, view));
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
  if (setting == Setting::best)
    refine(picture::kFineDifference, picture::kThirtyTwo);
  else
    refine(picture::kDifference, picture::kEight);
  return image;
}

}  // namespace voxmelt::render
