#include "library/picture_input.h"

#include <cstddef>
#include <cstring>

namespace voxmelt::library {
namespace {

void look_from(const Camera& from, scene::Camera& camera) {
  constexpr double kFarthest = 65536;  // the limit in scenes, too
  for (std::size_t axis = 0; axis < 3; ++axis)
    camera.target[axis] = checked("camera.target", from.target[axis], -kFarthest, kFarthest);
  camera.distance = checked("camera.distance", from.distance, 0.0, 4 * kFarthest);
  camera.azimuth = checked("camera.azimuth", from.azimuth, -360.0, 360.0);
  camera.elevation = checked("camera.elevation", from.elevation, -89.0, 89.0);
  camera.field_of_view = checked("camera.field_of_view", from.field_of_view, 1.0, 120.0);
  camera.orthographic = from.projection == Projection::orthographic;
}

}  // namespace

scene::Camera camera_of(scene::Camera camera, const Picture& picture) {
  if (picture.camera) look_from(*picture.camera, camera);
  if (picture.width) camera.width = checked("width", *picture.width, 16, scene::kWidestPicture);
  if (picture.height) camera.height = checked("height", *picture.height, 16, scene::kWidestPicture);
  if (picture.azimuth) camera.azimuth = checked("azimuth", *picture.azimuth, -360.0, 360.0);
  if (picture.elevation) camera.elevation = checked("elevation", *picture.elevation, -89.0, 89.0);
  return camera;
}

int row_alignment_of(const Picture& picture) {
  return checked("row_alignment", picture.row_alignment, 1, 4096);
}

Frame frame_of(const render::Image& image, int alignment) {
  const auto row = sizeof(render::Rgb) * static_cast<std::size_t>(image.width),
             unit = static_cast<std::size_t>(alignment), height = static_cast<std::size_t>(image.height);
  Frame frame{image.width, image.height, (row + unit - 1) / unit * unit, {}, {}, {}};
  frame.rgb.resize(frame.stride * height);
  for (int y = 0; y < image.height; ++y)
    std::memcpy(frame.rgb.data() + y * frame.stride, image.at(0, y).data(), row);
  return frame;
}

}  // namespace voxmelt::library
