#include "render/image/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voxmelt::render {
namespace {

constexpr float kMargin = 1.03f;  // air around a fitted grid

}  // namespace

CameraView::CameraView(const scene::Camera& camera, const state::Grid& grid) {
  const auto radians = [](double degrees) { return static_cast<float>(degrees * std::numbers::pi / 180); };
  const float azimuth = radians(camera.azimuth),
              elevation = radians(std::clamp(camera.elevation, -89.0, 89.0));
  const Vec back{std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                 std::cos(azimuth) * std::cos(elevation)};
  forward_ = -back;
  right_ = normalized(cross(forward_, {0, 1, 0}));
  up_ = cross(right_, forward_);
  half_width_ = static_cast<float>(camera.width) / 2;
  half_height_ = static_cast<float>(camera.height) / 2;
  tangent_ = std::tan(radians(camera.field_of_view) / 2);

  // The least distance at which every corner of the grid is inside the pyramid of view.
  const Vec target = vec(camera.target);
  float distance = static_cast<float>(camera.distance);
  if (distance <= 0) {
    const float tangent_x = tangent_ * half_width_ / half_height_;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec point{static_cast<float>(corner & 1 ? grid.x : 0),
                      static_cast<float>(corner & 2 ? grid.y : 0),
                      static_cast<float>(corner & 4 ? grid.z : 0)};
      const Vec from_target = point - target;
      const float depth = dot(from_target, back);
      distance = std::max({distance, depth + kMargin * std::abs(dot(from_target, right_)) / tangent_x,
                           depth + kMargin * std::abs(dot(from_target, up_)) / tangent_});
    }
  }
  position_ = target + back * distance;
}

Ray CameraView::ray(float pixel_x, float pixel_y) const {
  const float scale = tangent_ / half_height_;
  const Vec direction =
      forward_ + right_ * ((pixel_x - half_width_) * scale) + up_ * ((half_height_ - pixel_y) * scale);
  return {position_, normalized(direction)};
}

}  // namespace voxmelt::render
