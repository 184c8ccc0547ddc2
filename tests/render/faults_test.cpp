// Pictures once had these faults, and these tests hold them off:
//
// 1  holes in terrain, combs   GroundMap.TheVolcanoHasNoHole, LeavingOutChangesNothing (ground_map_test.cpp);
//                              Ground.IsThatOfADenseMarchInDouble, of 200 views (rule/ground_test.cpp)
// 2  seen through the slab     Fault.FromBelowTheSlabHidesEverything;
//                              GroundMap.FromBelowTheUndersideHidesAll (ground_map_test.cpp)
// 3  arcs in hills' shadows    Fault.ShadowOfARidgeIsMonotone
// 4  teeth of rims, bands      Rim.OfARoundPuddle, Rim.OfATongueOnASlope (rims_test.cpp);
//                              Smooth.TerracesOfAPuddleDoNotShow (smooth_test.cpp)
// 5  flicker                   Fault.SmallChangesMovePixelsLittle
// 6  a camera inside           Fault.ACameraInsideIsKnown; the warning: tests/app/frames_test.py
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <random>

#include "render/packet/picture.h"
#include "tests/kernel/worlds.h"
#include "tests/render/shapes.h"

namespace voxmelt {
namespace {

using render::Image;

Image drawn(const state::Volume& volume, const scene::Terrain& terrain, const scene::Camera& camera,
            const scene::Light& light = {}, const scene::Look& look = {}) {
  render::Picture picture;
  picture.update(volume, look, light, terrain, 1);
  return picture.draw(camera, render::Setting::fast, 1);
}

// From below, the slab hides a puddle, its shadow and everything buried. Its underside has one colour.
TEST(Fault, FromBelowTheSlabHidesEverything) {
  const state::Grid grid{48, 40, 48};
  state::Volume volume = test::ball_and_puddle(grid);
  for (int z = 20; z < 28; ++z)  // a solid that stands in the slab
    for (int x = 20; x < 28; ++x) {
      volume.inert.set(x, 1, z, false);
      volume.solid.set(x, 1, z, true);
      volume.amount[volume.at(x, 1, z)] = rule::kOne;
    }
  for (const double elevation : {-89.0, -60.0, -40.0}) {
    scene::Camera camera;
    camera.target = {24, 0, 24};
    camera.azimuth = 20;
    camera.elevation = elevation;
    camera.distance = 60;
    camera.field_of_view = 20;  // the underside fills the picture
    camera.width = camera.height = 96;
    const Image image = drawn(volume, test::floor_terrain(grid), camera);
    render::Rgb low = image.pixels[0], high = low;
    for (const render::Rgb& pixel : image.pixels)
      for (std::size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], pixel[c]);
        high[c] = std::max(high[c], pixel[c]);
      }
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_LE(high[c] - low[c], 3) << elevation << " " << c;
      EXPECT_GT(low[c], 0) << elevation << " " << c;
    }
    EXPECT_LT(low[1], 150) << "the underside is dark";
  }
}

// Behind a ridge the floor gets lighter and lighter, from the shadow to the open, without arcs.
TEST(Fault, ShadowOfARidgeIsMonotone) {
  const state::Grid grid{96, 32, 32};
  scene::Terrain terrain = test::floor_terrain(grid);
  constexpr double kRidge = 20;
  for (const double height : {12.0, 18.0})
    for (const double rise : {0.3, 0.45}) {
      state::Volume volume(grid);
      for (int z = 0; z < grid.z; ++z)
        for (int x = 0; x < grid.x; ++x) {
          const double top = std::max(2.0, height - 3 * std::abs(x + 0.5 - kRidge));
          terrain.height[static_cast<std::size_t>(z * grid.x + x)] = static_cast<float>(top);
          for (int y = 0; y < std::lround(top); ++y) {
            volume.inert.set(x, y, z, true);
            volume.amount[volume.at(x, y, z)] = rule::kBedHalf;
          }
        }
      scene::Light light;
      light.direction = {-1, rise, 0};
      scene::Camera camera;
      camera.target = {48, 2, 16};
      camera.azimuth = 0;
      camera.elevation = 89;
      camera.distance = 100;
      camera.field_of_view = 30;
      camera.width = 400;
      camera.height = 100;
      const Image image = drawn(volume, terrain, camera, light);
      const double pixels = 50 / (100 * std::tan(15 * std::numbers::pi / 180));  // pixels to a cell
      const auto column = [&](double x) { return static_cast<int>(std::lround(200 + (x - 48) * pixels)); };
      int brightest = 0, worst = 0;
      const int first = column(kRidge + 8), last = column(92);
      for (int x = first; x <= last; ++x) {
        const int here = image.at(x, 50)[1];
        worst = std::max(worst, brightest - here);
        brightest = std::max(brightest, here);
      }
      EXPECT_LE(worst, 3) << height << " " << rise;
      EXPECT_GT(brightest - image.at(first, 50)[1], 25) << height << " " << rise;
    }
}

// Holds the largest change of a channel, and the difference between the picture's lowest and highest channel.
struct Change {
  int most = 0, contrast = 0;
};
Change change_of(const Image& before, const Image& after) {
  Change change;
  int low = 255, high = 0;
  for (std::size_t i = 0; i < before.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      change.most = std::max(change.most, std::abs(before.pixels[i][c] - after.pixels[i][c]));
      low = std::min<int>(low, before.pixels[i][c]);
      high = std::max<int>(high, before.pixels[i][c]);
    }
  change.contrast = high - low;
  return change;
}

// Every amount moves by up to 1/512 of a cell, there and back. Along a silhouette two samples of a pixel may
// then come to lie on its other side, but not more. That is a quarter of the contrast in the normal picture.
// In the best one it is 8 levels, as the look is dull: all levels are within 128.
TEST(Fault, SmallChangesMovePixelsLittle) {
  const state::Grid grid{48, 40, 48};
  const state::Volume still = test::ball_and_puddle(grid);
  const scene::Terrain terrain = test::floor_terrain(grid);
  scene::Look look;
  look.specular = 0;
  look.solid = look.liquid = look.ground = look.background = {0.5, 0.5, 0.5};
  scene::Light light;
  light.ambient = 0.7;
  render::Picture picture;
  std::mt19937 random(5);
  std::uniform_int_distribution<int> shift(-8, 8);
  const auto draw = [&](const state::Volume& volume, double elevation, render::Setting setting) {
    scene::Camera camera = test::small_camera(grid, 320, 240);
    camera.elevation = elevation;
    camera.azimuth = 5 * elevation;
    picture.update(volume, look, light, terrain, 1);
    return picture.draw(camera, setting, 1);
  };
  using render::Setting;
  for (const double elevation : {8.0, 28.0, 70.0}) {
    const Image best = draw(still, elevation, Setting::best),
                normal = draw(still, elevation, Setting::normal);
    int seen = 0;
    for (int round = 0; round < 6; ++round) {
      state::Volume moved = still;
      worlds::for_each(worlds::whole(grid), [&](int x, int y, int z) {
        const state::Slot at = still.at(x, y, z);
        if (still.inert.test(x, y, z) || still.amount[at] == 0) return;
        moved.amount[at] = static_cast<std::uint16_t>(std::clamp(still.amount[at] + shift(random), 1, 4096));
      });
      const Change of_best = change_of(best, draw(moved, elevation, Setting::best)),
                   of_normal = change_of(normal, draw(moved, elevation, Setting::normal));
      EXPECT_LT(of_best.contrast, 128);
      EXPECT_LE(of_best.most, 8) << elevation << ", round " << round;
      EXPECT_LE(of_normal.most, of_normal.contrast / 4) << elevation << ", round " << round;
      seen += of_best.most;
    }
    EXPECT_GT(seen, 0) << "no change was drawn";
    EXPECT_TRUE(best == draw(still, elevation, Setting::best)) << elevation;
  }
}

// The eye is a quarter of a cell from the target, at a height y above the middle of the puddle.
TEST(Fault, ACameraInsideIsKnown) {
  const state::Grid grid{48, 40, 48};
  render::Picture picture;
  picture.update(test::ball_and_puddle(grid), {}, {}, test::floor_terrain(grid), 1);
  scene::Camera camera;
  camera.azimuth = camera.elevation = 0;
  camera.distance = 0.25;
  const auto inside = [&](double x, double y) {
    camera.target = {x, y, 24};
    return picture.camera_inside(camera);
  };
  EXPECT_TRUE(inside(24, 1));    // floor
  EXPECT_TRUE(inside(24, 3));    // puddle
  EXPECT_FALSE(inside(24, 7));   // air between the puddle and the ball
  EXPECT_TRUE(inside(24, 20));   // ball
  EXPECT_FALSE(inside(24, 35));  // air of the grid
  EXPECT_FALSE(inside(24, 80));  // above the grid
  EXPECT_FALSE(inside(80, 1));   // beside the slab
  EXPECT_FALSE(picture.camera_inside(test::small_camera(grid)));
}

}  // namespace
}  // namespace voxmelt
