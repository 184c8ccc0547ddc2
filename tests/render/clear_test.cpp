// Rays pass through clear matter. Their ways through balls and slabs, and the sums of these, agree with
// analytic ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "render/packet/clear_painter.h"
#include "render/packet/painter.h"
#include "render/packet/picture.h"
#include "render/packet/scene_in_integers.h"
#include "render/packet/tables.h"
#include "render/reference/picture_scene.h"
#include "tests/render/rule/levels.h"
#include "tests/render/shapes.h"

namespace voxmelt {
namespace {

using picture::Color;
using picture::Vector;
using test::CubeOfLevels;

// A shiny and frosted look would hide how long the way is.
scene::Look dull_look(double half) {
  scene::Look look;
  look.solid = look.liquid = {1, 0.5, 0.25};
  look.specular = 0;
  look.clear = {half, half, half};
  look.frost = 0;
  return look;
}

// Holds levels in the open, and tells what rays meet in them.
class Fog {
 public:
  explicit Fog(const CubeOfLevels& levels, const scene::Look& look = dull_look(8))
      : levels_(levels),
        paint_(picture::paint_of(render::look_in_integers(look), render::lamp_in_integers({}))) {}

  // The coordinates are in cells, and the step is 2^-spacing along the largest component.
  picture::Ray ray(double x, double y, double z, double dx, double dy, double dz, int spacing = 2) const {
    const auto fixed = [](double a) { return std::llround(std::ldexp(a, 20)); };
    return {{fixed(x), fixed(y), fixed(z)},
            picture::step_along({fixed(4096 * dx), fixed(4096 * dy), fixed(4096 * dz)}, spacing)};
  }
  struct Seen {
    bool ground;
    Color passed, sum;
  };
  Seen seen(const picture::Ray& ray, int spacing = 2, const picture::GroundCrossing& ground = {}) const {
    const Light light;
    const Vector one{1, 1, 1};
    const render::PaintedScene<CubeOfLevels, Inside, Light> scene{
        levels_, levels_.cells(), inside_, none_, light, one, 1, paint_, background_, render::tone_table()};
    render::ClearPainter along(scene, ray, ground, spacing, 0);
    const bool arrived = along.follow(picture::first_crossing(levels_, levels_.cells(), ray));
    return {arrived, along.passed(), along.sum({})};
  }
  // Returns the length of the way in matter, in cells, by the light that passes.
  double way(const Seen& seen, double half = 8) const { return -half * std::log2(seen.passed[1] / 32768.0); }
  void put_obstacle_from(std::int64_t x) { inside_.obstacle_from = x; }
  const picture::Paint& paint() const { return paint_; }

 private:
  struct Inside {
    std::int64_t obstacle_from = 1000;
    picture::Matter operator()(std::int64_t x, std::int64_t, std::int64_t) const {
      return {0, 0, x >= obstacle_from ? 255 : 0};
    }
  };
  struct Light {
    picture::Light operator()(std::int64_t, std::int64_t, std::int64_t) const { return {}; }
  };
  const CubeOfLevels& levels_;
  picture::Paint paint_;
  Inside inside_;
  render::GroundMap none_;
  Color background_{};
};

// Makes matter from cell `low` to cell `high` - 1 along x. Its surfaces are at low and high.
CubeOfLevels slab(int side, int low, int high) {
  return {side, [=](int x, int, int) { return x >= low && x < high ? 32640 : -32640; }};
}

TEST(Clear, TheWayThroughABallIsItsChord) {
  const CubeOfLevels ball = test::ball_of_levels(32, 10);
  const Fog fog(ball);
  for (const double aside : {0.0, 3.0, 6.5, 9.0})
    for (const double lean : {0.0, 0.3, -0.9}) {
      // The line passes the middle of the ball at the distance `aside`.
      const double length = std::hypot(1, lean), x = -1, to = 16 - x;
      const double y = 16 - to * lean + aside * length;
      double fast = 0;
      for (const int spacing : {2, 3}) {
        const double way = fog.way(fog.seen(fog.ray(x, y, 16, 1, lean, 0, spacing), spacing));
        EXPECT_NEAR(way, 2 * std::sqrt(100 - aside * aside), 0.25) << aside << ", " << lean;
        if (spacing == 2) fast = way;
        EXPECT_NEAR(way, fast, 0.05) << aside << ", " << lean;
      }
    }
}

TEST(Clear, TheWayThroughASlabLengthensWithTheSlant) {
  const CubeOfLevels levels = slab(40, 10, 22);
  const Fog fog(levels);
  for (const double slope : {0.0, 0.25, 0.5, 1.0})
    EXPECT_NEAR(fog.way(fog.seen(fog.ray(2, 5, 20, 1, slope, 0))), 12 * std::hypot(1, slope), 0.03) << slope;
}

// The two slabs have 5 and 9 cells.
TEST(Clear, WaysAddUpBehindAGap) {
  const CubeOfLevels levels(
      40, [](int x, int, int) { return (x >= 5 && x < 10) || (x >= 20 && x < 29) ? 32640 : -32640; });
  const Fog fog(levels);
  EXPECT_NEAR(fog.way(fog.seen(fog.ray(1, 20, 20, 1, 0, 0))), 14, 0.03);
}

// Frost dims at both surfaces, (1 - 1/4)^2, and half of the light is lost on the way.
TEST(Clear, FrostDimsAtEachSurface) {
  const CubeOfLevels levels = slab(40, 10, 18);
  scene::Look look = dull_look(8);
  look.frost = 0.25;
  const Fog fog(levels, look);
  EXPECT_NEAR(fog.seen(fog.ray(2, 20, 20, 1, 0, 0)).passed[0], 32768 * 9 / 32.0, 60);
}

// Scattered and passed light add up to all, whatever the number of stretches, so no rounding adds up.
TEST(Clear, NothingIsLostInManyStretches) {
  const CubeOfLevels levels = slab(256, 10, 200);
  for (const double half : {1.0, 30.0, 256.0}) {
    const Fog fog(levels, dull_look(half));
    const Color inner = picture::inner_color(fog.paint(), {}, {});
    const Fog::Seen seen = fog.seen(fog.ray(2, 100, 100, 1, 0, 0));
    // Both surfaces are dull and let everything pass, so all of it comes from within.
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(seen.sum[c], ((32768 - seen.passed[c]) * inner[c]) >> 15);
    EXPECT_EQ(seen.passed == Color{}, half < 20) << half;
  }
}

TEST(Clear, ObstaclesWithinEndTheRay) {
  const CubeOfLevels levels = slab(40, 10, 30);
  Fog fog(levels, dull_look(64));
  const picture::Ray ray = fog.ray(2, 20, 20, 1, 0, 0);
  EXPECT_NEAR(fog.way(fog.seen(ray), 64), 20, 0.5);
  fog.put_obstacle_from(22);
  EXPECT_EQ(fog.seen(ray).passed, Color{});
}

// The ray starts at x = 2 in steps of 1/4, and the surface is at 10. An entry of the table is 1/32 cell.
TEST(Clear, TheGroundWithinEndsTheWay) {
  const CubeOfLevels levels = slab(40, 10, 30);
  const Fog fog(levels);
  for (const std::int64_t part : {62 * 256, 62 * 256 + 77, 62 * 256 + 255}) {
    const picture::GroundCrossing ground{true, part, {}, picture::Face::top};
    const Fog::Seen seen = fog.seen(fog.ray(2, 20, 20, 1, 0, 0), 2, ground);
    EXPECT_TRUE(seen.ground);
    EXPECT_NEAR(fog.way(seen), static_cast<double>(part) / 1024 - 8, 0.05) << part;
  }
  // One ground is right behind the surface, before the next sample, and one is before the surface.
  const picture::GroundCrossing close{true, 32 * 256 + 200, {}, picture::Face::top},
      before{true, 31 * 256, {}, picture::Face::top};
  const Fog::Seen within = fog.seen(fog.ray(1.95, 20, 20, 1, 0, 0), 2, close);
  EXPECT_TRUE(within.ground);
  EXPECT_NEAR(fog.way(within), 1.95 + 8392.0 / 1024 - 10, 0.05);
  EXPECT_EQ(fog.seen(fog.ray(2, 20, 20, 1, 0, 0), 2, before).passed, (Color{32768, 32768, 32768}));
}

// The way counts from the eye on, and there is no surface at the eye.
TEST(Clear, AnEyeInMatterSeesThroughIt) {
  const CubeOfLevels levels = slab(40, 10, 30);
  scene::Look look = dull_look(8);
  look.frost = 0.5;
  const Fog fog(levels, look);
  const Fog::Seen seen = fog.seen(fog.ray(22, 20, 20, 1, 0, 0));
  EXPECT_NEAR(seen.passed[0], 32768 / 4.0, 60);  // half on the way, half at the one surface
}

const state::Grid kGrid{40, 36, 40};

render::Image drawn(const state::Volume& volume, const scene::Look& look) {
  render::Picture picture;
  picture.update(volume, look, {}, test::floor_terrain(kGrid), 1);
  return picture.draw(test::small_camera(kGrid), render::Setting::normal, 1);
}

TEST(Clear, FrostAloneChangesNoOpaquePicture) {
  const state::Volume volume = test::ball_and_puddle(kGrid);
  scene::Look look;
  const render::Image before = drawn(volume, look);
  look.frost = 0.9;
  EXPECT_TRUE(before == drawn(volume, look));
  look.clear = {9, 9, 9};
  EXPECT_FALSE(before == drawn(volume, look));
}

// The lamp's light below a ball is next to none behind an opaque one, and more the clearer the ball is.
TEST(Clear, ShadowsOfClearMatterAreLighter) {
  const state::Volume volume = test::ball_and_puddle(kGrid);
  std::int32_t before = -1;
  for (const double half : {0.0, 2.0, 8.0, 60.0}) {
    scene::Look look;
    look.clear = {half, half, half};
    scene::Light light;
    light.direction = {0, 1, 0};
    render::DensityField field;
    field.update(volume, look);
    const render::PictureScene scene(field, look, light, {});
    std::int32_t least = 255;
    for (std::int64_t z = 0; z < scene.light.count().z; ++z)
      for (std::int64_t x = 0; x < scene.light.count().x; ++x)
        least = std::min(least, std::int32_t{scene.light(x, 0, z).lamp});
    EXPECT_GT(least, before) << half;
    before = least;
  }
  EXPECT_GT(before, 150);
}

}  // namespace
}  // namespace voxmelt
