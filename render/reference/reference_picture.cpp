#include "render/reference/reference_picture.h"

#include <cstdint>

#include "render/reference/reference_pixels.h"

namespace voxmelt::render {

SurfacePicture reference_surface(const PictureScene& scene, const picture::Camera& camera, Setting setting) {
  const ReferencePixels pixels(scene, camera, setting);
  SurfacePicture surface{static_cast<int>(camera.width), static_cast<int>(camera.height), {}, {}};
  for (std::int64_t y = 0; y < camera.height; ++y)
    for (std::int64_t x = 0; x < camera.width; ++x) {
      const Seen seen = pixels.seen(x, y);
      const std::int64_t depth =
          seen.found ? picture::depth_in_picture(pixels.view(), seen.position) : picture::kNoDepth;
      surface.depth.push_back(static_cast<std::uint16_t>(depth));
      surface.normal.push_back({static_cast<std::int16_t>(seen.normal.x),
                                static_cast<std::int16_t>(seen.normal.y),
                                static_cast<std::int16_t>(seen.normal.z)});
    }
  return surface;
}

Image reference_picture(const PictureScene& scene, const picture::Camera& camera, Setting setting) {
  return picture_of(ReferencePixels(scene, camera, setting), camera);
}

}  // namespace voxmelt::render
