// Rims of liquid seen from above are as smooth as the shapes they stand for.
//
// A tooth of one cell is off the line by half a cell to either side, and whole columns of liquid have such
// teeth. Drawn, a rim may be off by three tenths, a pixel of an eighth included.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "render/packet/picture.h"
#include "tests/render/shapes.h"

namespace voxmelt {
namespace {

constexpr double kMost = 0.3;  // cells
constexpr state::Grid kGrid{64, 48, 64};
constexpr int kPixelsPerCell = 8;

// Draws from above, from so far away that rays are parallel. No camera looks down more steeply than by 89
// degrees, so a place is seen a little nearer to the top the higher it lies.
struct FromAbove {
  FromAbove(const state::Volume& volume, const scene::Terrain& terrain) {
    scene::Look look;
    look.solid = look.liquid = {0.9, 0, 0};
    look.ground = {0, 0, 0.9};
    look.specular = 0;
    scene::Light light;
    light.direction = {0, 1, 0};
    scene::Camera camera;
    camera.target = {kGrid.x / 2.0, 0, kGrid.z / 2.0};
    camera.azimuth = 0;
    camera.elevation = 89;
    camera.distance = 2000;
    camera.width = camera.height = kGrid.x * kPixelsPerCell;
    camera.field_of_view = 2 * std::atan(kGrid.z / 2.0 / camera.distance) * 180 / std::numbers::pi;
    render::Picture picture;
    picture.update(volume, look, light, terrain, 1);
    image = picture.draw(camera, render::Setting::best, 1);
  }
  // Tells whether liquid is seen at a place of the grid, on a surface of height y.
  bool liquid(double x, double y, double z) const {
    constexpr double kTilt = std::numbers::pi / 180;
    z = kGrid.z / 2.0 + (z - kGrid.z / 2.0) * std::cos(kTilt) - y * std::sin(kTilt);
    const auto pixel = [](double at) {
      return std::clamp(static_cast<int>(std::floor(at * kPixelsPerCell)), 0, image_side - 1);
    };
    const render::Rgb& rgb = image.at(pixel(x), pixel(z));
    return rgb[0] > rgb[2];
  }
  // Returns the distance from (x, y, z) along (dx, 0, dz) to the end of the liquid.
  double rim(double x, double y, double z, double dx, double dz) const {
    double t = 0;
    while (t < kGrid.x && liquid(x + t * dx, y, z + t * dz)) t += 0.02;
    return t;
  }
  static constexpr int image_side = kGrid.x * kPixelsPerCell;
  render::Image image;
};

double spread(const std::vector<double>& all) {
  const auto [low, high] = std::minmax_element(all.begin(), all.end());
  return (*high - *low) / 2;
}

// The puddles have whole columns: a pancake with a steep rim, and a dome that ends in a thin film.
TEST(Rim, OfARoundPuddle) {
  for (const double radius : {11.3, 20.0, 24.6})
    for (const bool dome : {false, true}) {
      state::Volume volume = test::floor_volume(kGrid);
      int rims = 0;
      for (int z = 0; z < kGrid.z; ++z)
        for (int x = 0; x < kGrid.x; ++x) {
          const double r = std::hypot(x + 0.5 - kGrid.x / 2.0, z + 0.5 - kGrid.z / 2.0) / radius;
          if (r >= 1) continue;
          test::pour(volume, x, z, dome ? 4 * std::sqrt(1 - r * r) : 1.5);
          ++rims;
        }
      ASSERT_GT(rims, 300);
      const FromAbove seen(volume, test::floor_terrain(kGrid));
      std::vector<double> rim;
      for (int i = 0; i < 720; ++i) {
        const double turn = i * std::numbers::pi / 360;
        rim.push_back(seen.rim(kGrid.x / 2.0, test::kFloor, kGrid.z / 2.0, std::cos(turn), std::sin(turn)));
      }
      EXPECT_LT(spread(rim), kMost) << radius << (dome ? ", dome" : ", pancake");
      EXPECT_NEAR(rim[0], radius, 0.9) << radius << (dome ? ", dome" : ", pancake");
    }
}

// A tongue of lava runs down a slope, equally wide everywhere, so both of its sides are straight. Columns at
// its sides are covered in part.
TEST(Rim, OfATongueOnASlope) {
  for (const double rise : {0.2, 0.55})
    for (const double turn : {0.0, 0.13, 0.46, 0.7}) {
      const double ux = std::cos(turn), uz = std::sin(turn);  // downhill
      state::Volume volume(kGrid);
      scene::Terrain terrain = test::floor_terrain(kGrid);
      for (int z = 0; z < kGrid.z; ++z)
        for (int x = 0; x < kGrid.x; ++x) {
          const double dx = x + 0.5 - kGrid.x / 2.0, dz = z + 0.5 - kGrid.z / 2.0;
          const double height = 20 - rise * (dx * ux + dz * uz);
          terrain.height[static_cast<std::size_t>(z * kGrid.x + x)] = static_cast<float>(height);
          const int bed = static_cast<int>(std::lround(height));
          for (int y = 0; y < bed; ++y) {
            volume.inert.set(x, y, z, true);
            volume.amount[volume.at(x, y, z)] = rule::kBedHalf;
          }
          volume.amount[volume.at(x, bed - 1, z)] =
              static_cast<std::uint16_t>(rule::kBedHalf + std::lround((height - bed) * rule::kOne));
          // This share of the column is covered.
          const double covered = std::min(7.5 - std::abs(dz * ux - dx * uz), 1.0);
          if (covered <= 0) continue;
          volume.liquid.set(x, bed, z, true);
          volume.amount[volume.at(x, bed, z)] = static_cast<std::uint16_t>(std::ceil(covered * rule::kOne));
        }
      const FromAbove seen(volume, terrain);
      for (const double side : {-1.0, 1.0}) {
        std::vector<double> rim;
        for (double along = -18; along <= 18; along += 0.1)
          rim.push_back(seen.rim(kGrid.x / 2.0 + along * ux, 20 - rise * along, kGrid.z / 2.0 + along * uz,
                                 -side * uz, side * ux));
        EXPECT_LT(spread(rim), kMost) << rise << ' ' << turn << ' ' << side;
        EXPECT_NEAR(rim[0], 7.5, 0.7) << rise << ' ' << turn << ' ' << side;
      }
    }
}

}  // namespace
}  // namespace voxmelt
