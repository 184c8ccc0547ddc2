#include "app/surface_pictures.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/image/camera.h"
#include "render/raycast/levels.h"
#include "render/raycast/reference.h"
#include "render/rule/camera.h"

namespace voxmelt::app {
namespace {

constexpr int kSpacing = 2;           // samples are quarters of a cell apart
constexpr int kZeroNormal = 1 << 15;  // what stands for 0

}  // namespace

SurfacePictures surface_pictures(const render::DensityField& field, scene::Camera camera) {
  // A distance that the scene leaves open is the one of the coloured picture.
  if (camera.distance <= 0) {
    const render::CameraView view(camera, field.grid());
    camera.distance = length(view.position() - render::vec(camera.target));
  }
  const render::Levels levels(field);
  const picture::Camera integers = render::camera_in_integers(camera);
  const std::vector<render::SurfacePixel> pixels = render::surface_picture(levels, integers, kSpacing);

  SurfacePictures pictures{render::Image16(camera.width, camera.height, 1),
                           render::Image16(camera.width, camera.height, 3), 0};
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    pictures.depth.numbers[i] = pixels[i].depth;
    if (pixels[i].depth == picture::kNoDepth) continue;  // the normal stays (0, 0, 0), which no normal is
    for (std::size_t c = 0; c < 3; ++c)
      pictures.normals.numbers[3 * i + c] = static_cast<std::uint16_t>(kZeroNormal + pixels[i].normal[c]);
  }
  const picture::View view = picture::view_of(integers, levels.cells());
  pictures.near = static_cast<double>(view.near) / picture::kNearUnit;
  return pictures;
}

}  // namespace voxmelt::app
