#include "app/surface_pictures.h"

#include <cstddef>
#include <cstdint>

#include "render/packet/scene_in_integers.h"
#include "render/rule/camera.h"

namespace voxmelt::app {
namespace {

constexpr int kZeroNormal = 1 << 15;  // the number that stands for 0

}  // namespace

SurfacePictures surface_pictures(const render::Picture& picture, const scene::Camera& camera,
                                 render::Setting setting, int threads) {
  const render::SurfacePicture surface = picture.surface(camera, setting, threads);
  SurfacePictures pictures{render::Image16(camera.width, camera.height, 1),
                           render::Image16(camera.width, camera.height, 3), 0};
  for (std::size_t i = 0; i < surface.depth.size(); ++i) {
    pictures.depth.numbers[i] = surface.depth[i];
    if (surface.depth[i] == picture::kNoDepth) continue;  // the normal stays (0, 0, 0), which no normal is
    for (std::size_t c = 0; c < 3; ++c)
      pictures.normals.numbers[3 * i + c] = static_cast<std::uint16_t>(kZeroNormal + surface.normal[i][c]);
  }
  const picture::View view = picture.data(render::camera_in_integers(camera), setting).view;
  pictures.near = static_cast<double>(view.near) / picture::kNearUnit;
  return pictures;
}

}  // namespace voxmelt::app
