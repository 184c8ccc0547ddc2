// The surface in integers agrees with the cubic surface in double, ray by ray. Levels are tested by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "kernel/scene/scene.h"
#include "render/density/density_field.h"
#include "render/packet/scene_in_integers.h"
#include "render/reference/levels.h"
#include "render/rule/camera.h"
#include "render/rule/crossing.h"
#include "render/rule/normal.h"
#include "render/rule/ray.h"
#include "tests/render/cubic_surface.h"
#include "tests/render/shapes.h"
#include "tests/render/sight.h"

namespace voxmelt {
namespace {

using test::Hit;
using test::Point;

// A full cell alone, unfiltered, gives 170 and 43 of 256 along each axis.
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
  std::vector<double> along_normal, degrees;  // for rays that meet both surfaces, sorted
  double distance(double share) const { return at(along_normal, share); }
  double angle(double share) const { return at(degrees, share); }

 private:
  static double at(const std::vector<double>& sorted, double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }
};

Differences compare(const render::DensityField& field, const scene::Camera& camera, int spacing) {
  const render::Levels levels(field);
  const test::CubicSurface surface(field);
  const picture::View view = picture::view_of(render::camera_in_integers(camera), levels.cells());
  Differences all;
  for (int j = 0; j < camera.height; ++j)
    for (int i = 0; i < camera.width; ++i) {
      ++all.rays;
      const picture::Ray ray = picture::ray_through(view, i * picture::kPixel + picture::kPixel / 2,
                                                    j * picture::kPixel + picture::kPixel / 2, spacing);
      const picture::Crossing got = picture::first_crossing(levels, levels.cells(), ray);
      const picture::Samples in =
          picture::samples_in(ray, picture::field_low(), picture::field_high(levels.cells()));
      const Point start = test::point_of(ray.start, 20), step = test::point_of(ray.step, 20);
      const double pace = length(step);
      const std::optional<Hit> hit =
          surface.find(start, step * (1 / pace), pace * static_cast<double>(in.first),
                       pace * static_cast<double>(in.last));
      all.one_alone += got.found != hit.has_value();
      if (!got.found || !hit) continue;
      ++all.met;
      const Point position = test::point_of(got.position, 20);
      const Point normal = test::point_of(picture::normal_at(levels, got.position), 14);
      all.along_normal.push_back(std::abs(dot(position - hit->point, hit->normal)));
      all.degrees.push_back(std::acos(std::min(1.0, dot(normal, hit->normal))) * 57.2958);
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
    camera.width = camera.height = 128;
    const Differences all = compare(field, camera, 2);
    EXPECT_GT(all.met, 900U);
    EXPECT_LT(all.one_alone, 20U);
    EXPECT_LT(all.distance(0.5), 0.02);
    EXPECT_LT(all.distance(0.99), 0.3);
    EXPECT_LT(all.angle(0.5), 1.6);
    EXPECT_LT(all.angle(0.99), 25);
  }
}

}  // namespace
}  // namespace voxmelt
