#include "render/raycast/reference.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/rule/crossing.h"
#include "render/rule/normal.h"

namespace voxmelt::render {

std::vector<SurfacePixel> surface_picture(const Levels& levels, const picture::Camera& camera, int spacing) {
  const picture::View view = picture::view_of(camera, levels.cells());
  std::vector<SurfacePixel> picture;
  picture.reserve(static_cast<std::size_t>(camera.width * camera.height));
  for (std::int64_t j = 0; j < camera.height; ++j)
    for (std::int64_t i = 0; i < camera.width; ++i) {
      const picture::Ray ray = picture::ray_through(view, i * picture::kPixel + picture::kPixel / 2,
                                                    j * picture::kPixel + picture::kPixel / 2, spacing);
      SurfacePixel& pixel = picture.emplace_back();
      const picture::Crossing crossing = picture::first_crossing(levels, levels.cells(), ray);
      if (!crossing.found) continue;
      const picture::Vector normal = picture::normal_at(levels, crossing.position);
      pixel.position = crossing.position;
      pixel.depth = static_cast<std::uint16_t>(picture::depth_in_picture(view, crossing.position));
      pixel.normal[0] = static_cast<std::int16_t>(normal.x);
      pixel.normal[1] = static_cast<std::int16_t>(normal.y);
      pixel.normal[2] = static_cast<std::int16_t>(normal.z);
    }
  return picture;
}

}  // namespace voxmelt::render
