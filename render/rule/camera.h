// The camera of a scene file gives the ray of each pixel (docs/picture/definition.md, sections 3 and 4).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "render/rule/angle.h"
#include "render/rule/fixed_point.h"
#include "render/rule/ray.h"
#include "render/rule/watch.h"

namespace voxmelt::picture {

struct Camera {
  Vector target;                            // in kCell, within 2^16 cells
  std::int64_t distance = 0;                // in 2^-12 cells, up to 2^18 cells; 0: so that the grid fits
  std::int64_t azimuth = 0, elevation = 0;  // in kDegree
  std::int64_t half_field = 0;              // half of the vertical field of view, in kDegree
  std::int64_t width = 0, height = 0;       // size of the picture, in pixels
  // True if all rays are parallel. The picture then shows as much as a perspective shows at the target.
  bool parallel = false;
};

inline constexpr std::int64_t kPixel = 64;     // picture coordinates per pixel
inline constexpr std::int64_t kNearUnit = 16;  // units per cell, for distances of the near plane

// Holds the numbers that all rays of a picture share.
struct View {
  Vector eye;                 // in kCell
  Vector forward, right, up;  // length kUnit
  Vector wide, high;      // right and up times the tangent of half the field of view, in kUnit; 0 if parallel
  std::int64_t near = 0;  // depth of the plane on which the rays start, in kNearUnit
  Vector near_wide, near_high;  // one picture coordinate further on that plane; 2^30 is a cell
  std::int64_t half_width = 0, half_height = 0;  // half the picture's size, in picture coordinates
  std::int64_t distance = 0;                     // distance of the camera from its target, in 2^-12 cells
  int halvings = 0;                              // halvings of the step of rays; see halvings_of
};

// Returns the depth of the nearest corner of the grid, a little less. The grid counts with half a cell around
// it.
VOXMELT_RULE std::int64_t near_depth(Vector eye, Vector forward, Vector cells) {
  std::int64_t near = std::int64_t{1} << 40;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector point{(corner & 1) != 0 ? cells.x * kCell + kCell / 2 : -kCell / 2,
                       (corner & 2) != 0 ? cells.y * kCell + kCell / 2 : -kCell / 2,
                       (corner & 4) != 0 ? cells.z * kCell + kCell / 2 : -kCell / 2};
    near = std::min(near, dot((point - eye) >> 16, forward) >> kUnitBits);
  }
  return near - 3;
}

// Returns the distance at which every corner of the grid is inside the picture, with a little air around it.
VOXMELT_RULE std::int64_t fitted_distance(const Camera& camera, Vector cells, const View& view,
                                          std::int64_t tangent) {
  std::int64_t distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector point{(corner & 1) != 0 ? cells.x * kCell : 0, (corner & 2) != 0 ? cells.y * kCell : 0,
                       (corner & 4) != 0 ? cells.z * kCell : 0};
    const Vector from_target = (point - camera.target) >> 8;
    const auto along = [&](Vector axis) { return dot(from_target, axis) >> kUnitBits; };
    const auto reach = [&](std::int64_t aside) {  // 1055 / 1024 is the air; tangents count from the middle
      return floor_divided(std::min(magnitude(aside) * 1055, std::int64_t{1} << 42) << 20, tangent);
    };
    const std::int64_t depth = camera.parallel ? 0 : -along(view.forward);
    distance =
        std::max({distance, depth + reach(floor_divided(along(view.right) * camera.height, camera.width)),
                  depth + reach(along(view.up))});
  }
  return std::clamp<std::int64_t>(distance, 1, std::int64_t{1} << 30);
}

// Returns how often the step of rays is halved because pixels are small. The height of a pixel on the near
// plane is tangent near / (2^33 height) cells. The limits are 15/128 of a cell and half of that.
VOXMELT_RULE int halvings_of(std::int64_t tangent, std::int64_t near, std::int64_t height) {
  const std::int64_t pixel = tangent * near, limit = height * (std::int64_t{15} << 25);  // below 2^56, 2^50
  return pixel >= 2 * limit ? 0 : pixel >= limit ? 1 : 2;
}

VOXMELT_RULE View view_of(const Camera& camera, Vector cells) {
  const SineCosine azimuth = sine_cosine(camera.azimuth), elevation = sine_cosine(camera.elevation),
                   half_field = sine_cosine(camera.half_field);
  const auto times = [](std::int64_t a, std::int64_t b) { return rounded(a * b, kUnitBits); };
  const Vector back{times(azimuth.sine, elevation.cosine), elevation.sine,
                    times(azimuth.cosine, elevation.cosine)};
  View view;
  view.forward = Vector{} - back;
  view.right = {azimuth.cosine, 0, -azimuth.sine};
  view.up = {-times(azimuth.sine, elevation.sine), elevation.cosine, -times(azimuth.cosine, elevation.sine)};
  const std::int64_t tangent = half_field.sine * kUnit / half_field.cosine;
  const std::int64_t distance =
      camera.distance > 0 ? camera.distance : fitted_distance(camera, cells, view, tangent);
  view.distance = distance;
  view.eye = camera.target + ((back * distance) >> 22);

  view.wide = (view.right * tangent) >> kUnitBits;
  view.high = (view.up * tangent) >> kUnitBits;
  view.half_width = camera.width * (kPixel / 2);
  view.half_height = camera.height * (kPixel / 2);

  const std::int64_t near = near_depth(view.eye, view.forward, cells);
  if (camera.parallel && near < 1) view.eye = view.eye + ((view.forward * (near - 1)) >> 14);
  view.near = std::max<std::int64_t>(camera.parallel ? 1 : 0, near);

  // The width of the picture on the near plane follows from that plane's depth, or with parallel rays from
  // the target's.
  constexpr std::int64_t kFiner = 4096 / kNearUnit;
  view.halvings = halvings_of(tangent, camera.parallel ? distance / kFiner : view.near, camera.height);
  const auto on_plane = [&](std::int64_t a) {
    return camera.parallel ? floor_divided(a * distance, view.half_height * 16 * kFiner)
                           : floor_divided(a * view.near, view.half_height * 16);
  };
  view.near_wide = {on_plane(view.wide.x), on_plane(view.wide.y), on_plane(view.wide.z)};
  view.near_high = {on_plane(view.high.x), on_plane(view.high.y), on_plane(view.high.z)};
  if (camera.parallel) view.wide = view.high = {};
  return view;
}

// Returns the ray through a place of the picture. `across` and `down` count from its upper left corner, in
// 1/kPixel of a pixel. The middle of pixel (i, j) is (kPixel i + kPixel / 2, kPixel j + kPixel / 2).
template <class Watch = Silent>
VOXMELT_RULE Ray ray_through(const View& view, std::int64_t across, std::int64_t down, int spacing,
                             Watch watch = {}) {
  const std::int64_t u = across - view.half_width, v = view.half_height - down;
  const Vector direction = view.forward * view.half_height + view.wide * u + view.high * v;
  const Vector start =
      view.eye + ((view.forward * view.near) >> 14) + ((view.near_wide * u + view.near_high * v) >> 10);
  const Vector step = step_along(direction, spacing);
  watch(Stage::ray, "place", std::array{across, down});
  watch(Stage::ray, "direction", direction);
  watch(Stage::ray, "start", start);
  watch(Stage::ray, "step", step);
  return {start, step};
}

// Distances of a position from the eye, along the direction of view, are in 1 / kDepthUnit of a cell.
inline constexpr std::int64_t kDepthUnit = 4096;
VOXMELT_RULE std::int64_t depth_from_eye(const View& view, Vector position) {
  return dot((position - view.eye) >> 8, view.forward) >> kUnitBits;
}
// Returns the depth of a position in a depth picture. It counts 32nds of a cell from the plane on which the
// rays start.
inline constexpr std::int64_t kNoDepth = 65535;  // depth of a ray that meets nothing
VOXMELT_RULE std::int64_t depth_in_picture(const View& view, Vector position) {
  return std::clamp<std::int64_t>((depth_from_eye(view, position) - view.near * 256) >> 7, 0, kNoDepth - 1);
}

}  // namespace voxmelt::picture
