// The reference draws its pixels one by one (docs/picture/definition.md, section 10).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/image/image.h"
#include "render/packet/draw_picture.h"
#include "render/packet/painter.h"
#include "render/packet/tables.h"
#include "render/reference/picture_scene.h"
#include "render/rule/antialias.h"
#include "render/rule/camera.h"
#include "render/rule/watch.h"

namespace voxmelt::render {

template <class Watch = picture::Silent>
class ReferencePixels {
 public:
  ReferencePixels(const PictureScene& scene, const picture::Camera& camera, Setting setting, Watch watch = {})
      : parts_{scene.levels,        scene.levels.cells(), scene.matter, scene.ground,          scene.light,
               scene.light.count(), scene.light.shift(),  scene.paint,  scene.look.background, tone_table()},
        view_(picture::view_of(camera, scene.levels.cells())),
        setting_(setting),
        width_(camera.width),
        height_(camera.height),
        painter_(parts_, view_, spacing_of(setting, view_), watch),
        watch_(watch) {}
  ReferencePixels(const ReferencePixels&) = delete;
  ReferencePixels& operator=(const ReferencePixels&) = delete;

  const picture::View& view() const { return view_; }
  Seen seen(std::int64_t x, std::int64_t y) const {
    const auto [across, down] = picture::kMiddle[0];
    return painter_.seen(x * picture::kPixel + across, y * picture::kPixel + down);
  }
  Rgb with_one_sample(std::int64_t x, std::int64_t y) const { return mean(x, y, picture::kMiddle); }
  Rgb with_more_samples(std::int64_t x, std::int64_t y) const {
    return setting_ == Setting::best ? mean(x, y, picture::kThirtyTwo) : mean(x, y, picture::kEight);
  }
  // Tells whether a pixel needs more samples. The function at(x, y) gives the pixels of a picture with one
  // sample a pixel.
  template <class At>
  bool needs_more_samples(const At& at, std::int64_t x, std::int64_t y) const {
    if (setting_ == Setting::fast) return false;
    const int most = setting_ == Setting::best ? picture::kFineDifference : picture::kDifference;
    const Rgb here = at(x, y);
    const auto differs = [&](std::int64_t nx, std::int64_t ny) {
      if (nx < 0 || ny < 0 || nx >= width_ || ny >= height_) return false;
      return picture::differ(here, at(nx, ny), most);
    };
    return differs(x - 1, y) || differs(x + 1, y) || differs(x, y - 1) || differs(x, y + 1);
  }

 private:
  using Scene = PaintedScene<Levels, MatterCells, LightVolume>;

  template <class Pattern>
  Rgb mean(std::int64_t x, std::int64_t y, const Pattern& pattern) const {
    watch_(picture::Stage::pixel, "pixel", std::array{x, y});
    picture::Color light{};
    for (const picture::Sub& sub : pattern) {
      const picture::Color one =
          painter_.light(x * picture::kPixel + sub.across, y * picture::kPixel + sub.down);
      for (std::size_t c = 0; c < 3; ++c) light[c] += one[c];
    }
    const auto count = static_cast<std::int32_t>(pattern.size());
    Rgb bytes{};
    for (std::size_t c = 0; c < 3; ++c) {
      light[c] = (light[c] + count / 2) / count;
      bytes[c] = byte_table()[light[c]];
    }
    watch_(picture::Stage::pixel, "samples", count);
    watch_(picture::Stage::pixel, "light", light);
    watch_(picture::Stage::pixel, "bytes", bytes);
    return bytes;
  }

  const Scene parts_;
  const picture::View view_;
  const Setting setting_;
  const std::int64_t width_, height_;
  const Painter<Scene, Watch> painter_;
  const Watch watch_;
};

// Draws the whole picture.
template <class Watch>
Image picture_of(const ReferencePixels<Watch>& pixels, const picture::Camera& camera) {
  Image image(static_cast<int>(camera.width), static_cast<int>(camera.height));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) image.at(x, y) = pixels.with_one_sample(x, y);
  const Image before = image;
  const auto at = [&](std::int64_t x, std::int64_t y) {
    return before.at(static_cast<int>(x), static_cast<int>(y));
  };
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (pixels.needs_more_samples(at, x, y)) image.at(x, y) = pixels.with_more_samples(x, y);
  return image;
}

}  // namespace voxmelt::render
