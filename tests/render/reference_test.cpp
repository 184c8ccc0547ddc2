// The picture in integers against the cubic surface in floats, ray by ray; levels by hand.
#include "render/raycast/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernel/scene/scene.h"
#include "render/density/density_field.h"
#include "render/image/camera.h"
#include "render/raycast/levels.h"
#include "render/raycast/surface.h"
#include "tests/render/shapes.h"

namespace voxmelt {
namespace {

// A full cell alone, unfiltered: 170 and 43 of 256 along each axis.
TEST(Levels, AFullCellByHand) {
  const state::Grid grid{7, 9, 8};
  state::Volume volume(grid);
  volume.solid.set(3, 4, 3, true);
  volume.amount[volume.at(3, 4, 3)] = rule::kOne;
  scene::Look look;
  look.smooth = look.smooth_solid = 0;
  render::DensityField field;
  field.update(volume, look);
  const render::Levels levels(field);
  EXPECT_EQ(levels(3, 4, 3), 19116 - 32640);  // 65280 -> 43350 -> 28787 -> 19116
  EXPECT_EQ(levels(2, 4, 3), 4835 - 32640);   // 65280 -> 10965 -> 7281 -> 4835
  EXPECT_EQ(levels(3, 5, 3), 4835 - 32640);   // 65280 -> 43350 -> 7281 -> 4835
  EXPECT_EQ(levels(2, 5, 4), 309 - 32640);    // 65280 -> 10965 -> 1842 -> 309
  EXPECT_EQ(levels(1, 4, 3), -32640);
  EXPECT_EQ(levels(-1, 4, 3), -32640);
}

struct Differences {
  std::size_t rays = 0, met = 0, one_alone = 0;
  std::vector<double> along_normal, degrees;  // of rays that meet both surfaces, sorted
  double distance(double share) const { return at(along_normal, share); }
  double angle(double share) const { return at(degrees, share); }

 private:
  static double at(const std::vector<double>& sorted, double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }
};

Differences compare(const render::DensityField& field, const scene::Camera& camera, int spacing) {
  const render::Levels levels(field);
  const auto picture = render::surface_picture(levels, render::camera_in_integers(camera), spacing);
  const render::Surface surface(field, true);
  const render::CameraView view(camera, field.grid());
  Differences all;
  for (int j = 0; j < camera.height; ++j)
    for (int i = 0; i < camera.width; ++i) {
      const render::SurfacePixel& pixel = picture[all.rays++];
      const render::Ray ray = view.ray(static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f);
      const std::optional<render::Hit> hit = surface.find(ray, 1e6f);
      const bool met = pixel.depth != picture::kNoDepth;
      all.one_alone += met != hit.has_value();
      if (!met || !hit) continue;
      ++all.met;
      const auto cells = [](std::int64_t a) {
        return static_cast<float>(std::ldexp(static_cast<double>(a), -20));
      };
      const render::Vec position{cells(pixel.position.x), cells(pixel.position.y), cells(pixel.position.z)};
      const render::Vec normal{static_cast<float>(pixel.normal[0]), static_cast<float>(pixel.normal[1]),
                               static_cast<float>(pixel.normal[2])};
      all.along_normal.push_back(std::abs(dot(position - hit->point, hit->normal)));
      all.degrees.push_back(std::acos(std::min(1.0f, dot(normal, hit->normal) / 16384)) * 57.2958);
    }
  std::sort(all.along_normal.begin(), all.along_normal.end());
  std::sort(all.degrees.begin(), all.degrees.end());
  return all;
}

// The gates are about 1.3 times what was seen. Only the surface between the cells differs: trilinear here,
// cubic there.
TEST(Reference, CelloIsNearTheCubicSurface) {
  const scene::Scene cello = scene::load(VOXMELT_SCENES_FOLDER "/cello.toml", {});
  render::DensityField field;
  field.update(cello.initial, cello.look, cello.terrain);
  for (const double azimuth : {28.0, 118.0, 250.0}) {
    scene::Camera camera = cello.camera;
    camera.azimuth = azimuth;
    camera.width = camera.height = 256;
    const Differences all = compare(field, camera, 2);
    EXPECT_GT(all.met, 3500U);
    EXPECT_LT(all.one_alone, 70U);
    EXPECT_LT(all.distance(0.5), 0.02);
    EXPECT_LT(all.distance(0.99), 0.3);
    EXPECT_LT(all.angle(0.5), 1.6);
    EXPECT_LT(all.angle(0.99), 25);
  }
}

}  // namespace
}  // namespace voxmelt
