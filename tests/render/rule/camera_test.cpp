// Angles and rays agree with plain double computations.
#include "render/rule/camera.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "render/rule/angle.h"
#include "render/rule/fixed_point.h"
#include "render/rule/ray.h"

namespace voxmelt::picture {
namespace {

using Triple = std::array<double, 3>;

double dot(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Triple along(const Triple& from, const Triple& direction, double t) {
  return {from[0] + direction[0] * t, from[1] + direction[1] * t, from[2] + direction[2] * t};
}
Triple cells_of(Vector v) {
  const auto cells = [](std::int64_t a) { return static_cast<double>(a) / static_cast<double>(kCell); };
  return {cells(v.x), cells(v.y), cells(v.z)};
}
double distance(const Triple& a, const Triple& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST(Angle, QuartersAreExact) {
  const auto is = [](std::int64_t degrees, std::int64_t sine, std::int64_t cosine) {
    const SineCosine got = sine_cosine(degrees * kDegree);
    EXPECT_EQ(got.sine, sine * kUnit) << degrees;
    EXPECT_EQ(got.cosine, cosine * kUnit) << degrees;
  };
  is(0, 0, 1);
  is(90, 1, 0);
  is(180, 0, -1);
  is(270, -1, 0);
  is(360, 0, 1);
  is(-90, -1, 0);
  is(-450, -1, 0);
}

// 17 terms are cut by less than 1 each, and pi by less than 1. So the sums are within 10 of the true values.
TEST(Angle, IsThatOfTheMathematicians) {
  for (std::int64_t angle = -400 * kDegree; angle < 400 * kDegree; angle += 4099) {
    const double radians = static_cast<double>(angle) / static_cast<double>(kDegree) * std::numbers::pi / 180;
    const SineCosine got = sine_cosine(angle);
    ASSERT_NEAR(static_cast<double>(got.sine), std::sin(radians) * static_cast<double>(kUnit), 10) << angle;
    ASSERT_NEAR(static_cast<double>(got.cosine), std::cos(radians) * static_cast<double>(kUnit), 10) << angle;
  }
}

// With a tangent of 1 and 512 rows a pixel is as high as 2 / 512 of its distance. This is 15/128 of a cell at
// 30 cells, and half of that at 15.
TEST(Camera, StepsAreHalvedWherePixelsAreSmall) {
  EXPECT_EQ(halvings_of(kUnit, 16 * 30, 512), 0);
  EXPECT_EQ(halvings_of(kUnit, 16 * 30 - 1, 512), 1);
  EXPECT_EQ(halvings_of(kUnit, 16 * 15, 512), 1);
  EXPECT_EQ(halvings_of(kUnit, 16 * 15 - 1, 512), 2);
  EXPECT_EQ(halvings_of(kUnit, 0, 1), 2);
  EXPECT_EQ(halvings_of(kUnit - 1, 16 * 30, 512), 1);  // a narrower view, or more rows
  EXPECT_EQ(halvings_of(kUnit, 16 * 30, 513), 1);
  EXPECT_EQ(halvings_of(4 * kUnit, 1 << 24, 1 << 20), 0);  // 4 x 2^21 / 2^20 cells; no product wraps
  // The straight view below is 99.3 cells from its near plane, so 30 / 99.3 x 512 is 1694 rows.
  Camera camera{{32 * kCell, 32 * kCell, 64 * kCell}, 100 << 12, 0, 0, 45 * kDegree, 8, 4};
  for (const auto& [rows, halvings] : {std::array{1690, 0}, {1700, 1}, {3380, 1}, {3400, 2}}) {
    camera.height = rows;
    EXPECT_EQ(view_of(camera, {64, 64, 64}).halvings, halvings) << rows;
  }
  camera.distance = 1 << 12;  // the eye is in the grid
  EXPECT_EQ(view_of(camera, {64, 64, 64}).halvings, 2);
}

// The camera looks along -z from 100 cells away with a right angle of view, so every number is a short one.
TEST(Camera, AStraightView) {
  const Camera camera{{32 * kCell, 32 * kCell, 64 * kCell}, 100 << 12, 0, 0, 45 * kDegree, 8, 4};
  const View view = view_of(camera, {64, 64, 64});
  EXPECT_EQ(view.eye, (Vector{32 * kCell, 32 * kCell, 164 * kCell}));
  EXPECT_EQ(view.forward, (Vector{0, 0, -kUnit}));
  EXPECT_EQ(view.right, (Vector{kUnit, 0, 0}));
  EXPECT_EQ(view.up, (Vector{0, kUnit, 0}));
  EXPECT_NEAR(static_cast<double>(view.wide.x), static_cast<double>(kUnit), 20);
  EXPECT_EQ(view.near, 16 * 99 + 8 - 3);  // the grid and half a cell, less 3 sixteenths

  // In the middle of the picture, the ray starts on the plane and goes a quarter of a cell at a time.
  const Ray middle = ray_through(view, 256, 128, 2);
  EXPECT_EQ(middle.start, (Vector{32 * kCell, 32 * kCell, 164 * kCell - view.near * kCell / 16}));
  EXPECT_EQ(middle.step, (Vector{0, 0, -kCell / 4}));

  // A quarter of the height above the middle, and as far to the left, the ray goes half of the depth to the
  // side.
  const Ray corner = ray_through(view, 192, 64, 2);
  EXPECT_NEAR(static_cast<double>(corner.step.x), -static_cast<double>(kCell) / 8, 2);
  EXPECT_NEAR(static_cast<double>(corner.step.y), static_cast<double>(kCell) / 8, 2);
  EXPECT_EQ(corner.step.z, -kCell / 4);
  const double half_depth = static_cast<double>(view.near * kCell) / 32;
  EXPECT_NEAR(static_cast<double>(corner.start.x - view.eye.x), -half_depth, 1000);
  EXPECT_NEAR(static_cast<double>(corner.start.y - view.eye.y), half_depth, 1000);
}

// In the view from 100 cells away, the plane lies 99.3125 cells deep, and a depth counts in 32nds from there.
TEST(Camera, DepthByHand) {
  const Camera camera{{32 * kCell, 32 * kCell, 64 * kCell}, 100 << 12, 0, 0, 45 * kDegree, 8, 4};
  const View view = view_of(camera, {64, 64, 64});
  EXPECT_EQ(depth_in_picture(view, {32 * kCell, 32 * kCell, 164 * kCell - view.near * kCell / 16}), 0);
  EXPECT_EQ(depth_in_picture(view, {0, 7 * kCell, 64 * kCell}), 22);  // 0.6875 cells
  EXPECT_EQ(depth_in_picture(view, {0, 0, 0}), 22 + 64 * 32);
  EXPECT_EQ(depth_in_picture(view, {0, 0, 100 * kCell}), 0);                // before the plane
  EXPECT_EQ(depth_in_picture(view, {0, 0, -10000 * kCell}), kNoDepth - 1);  // as far as depths go
}

// Seen from the front with half a field of 45 degrees, a cube of 64 cells reaches 32 cells from the middle.
// Its front is 32 cells before its middle, and the air is 1055/1024. So the distance is 32 + 32 x 1055/1024
// cells, give or take a 4096th.
TEST(Camera, TheDistanceThatFitsByHand) {
  Camera camera{{32 * kCell, 32 * kCell, 32 * kCell}, 0, 0, 0, 45 * kDegree, 64, 64};
  const auto distance = [&] { return view_of(camera, {64, 64, 64}).eye.z / (kCell / 4096) - 32 * 4096; };
  EXPECT_NEAR(static_cast<double>(distance()), (32 + 32 * 1055.0 / 1024) * 4096, 2);
  camera.width = 128;  // wider: the height decides as before
  EXPECT_NEAR(static_cast<double>(distance()), (32 + 32 * 1055.0 / 1024) * 4096, 2);
  camera.width = 32;  // half as wide: twice as far behind the front
  EXPECT_NEAR(static_cast<double>(distance()), (32 + 64 * 1055.0 / 1024) * 4096, 2);
}

// The compiler refuses a constant whose computation overflows. These are the ends of all ranges.
struct Extreme {
  Samples samples;
  std::int64_t depth;
};
constexpr Extreme extreme(std::int64_t sign, std::int64_t width, std::int64_t height, std::int64_t across) {
  const Vector cells{1024, 1024, 1024};
  const std::int64_t far = sign * 65536 * kCell;
  const Camera camera{{far, far, far}, std::int64_t{1} << 30, 45 * kDegree, 35 * kDegree, 75 * kDegree, width,
                      height};
  const View view = view_of(camera, cells);
  const Ray ray = ray_through(view, across, 0, 3);
  return {samples_in(ray, {-kCell, -kCell, -kCell}, cells * kCell), depth_in_picture(view, {})};
}

TEST(Camera, NothingOverflowsAtTheEndsOfTheRanges) {
  constexpr Extreme kExtremes[] = {extreme(1, 16384, 16, 0),  extreme(1, 16384, 16, 64 * 16384),
                                   extreme(-1, 16384, 16, 0), extreme(-1, 16384, 16, 64 * 16384),
                                   extreme(1, 1, 1, 64),      extreme(-1, 16, 16384, 0)};
  for (const Extreme& one : kExtremes) {
    EXPECT_GE(one.samples.first, 0);
    EXPECT_LE(one.depth, kNoDepth - 1);
  }
}

// For random cameras, the ray runs along that of a camera in double, and starts before the grid.
TEST(Camera, RaysAreThoseOfADoubleCamera) {
  std::mt19937 random(15);
  const auto within = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 2000; ++i) {
    const Vector cells{64, 100, 128};
    Camera camera;
    camera.target = {static_cast<std::int64_t>(within(-20, 80) * static_cast<double>(kCell)),
                     static_cast<std::int64_t>(within(-20, 80) * static_cast<double>(kCell)),
                     static_cast<std::int64_t>(within(-20, 80) * static_cast<double>(kCell))};
    camera.distance = static_cast<std::int64_t>(within(0.01, 2000) * 4096);
    camera.azimuth = static_cast<std::int64_t>(within(-400, 400) * static_cast<double>(kDegree));
    camera.elevation = static_cast<std::int64_t>(within(-89, 89) * static_cast<double>(kDegree));
    camera.half_field = static_cast<std::int64_t>(within(0.5, 75) * static_cast<double>(kDegree));
    camera.width = static_cast<std::int64_t>(within(1, 4000));
    camera.height = static_cast<std::int64_t>(within(1, 4000));
    const View view = view_of(camera, cells);

    const auto radians = [](std::int64_t angle) {
      return static_cast<double>(angle) / static_cast<double>(kDegree) * std::numbers::pi / 180;
    };
    const double azimuth = radians(camera.azimuth), elevation = radians(camera.elevation);
    const Triple forward{-std::sin(azimuth) * std::cos(elevation), -std::sin(elevation),
                         -std::cos(azimuth) * std::cos(elevation)};
    const Triple right{std::cos(azimuth), 0, -std::sin(azimuth)};
    const Triple up{-std::sin(azimuth) * std::sin(elevation), std::cos(elevation),
                    -std::cos(azimuth) * std::sin(elevation)};
    const Triple eye = along(cells_of(camera.target), forward, -static_cast<double>(camera.distance) / 4096);
    ASSERT_LT(distance(cells_of(view.eye), eye), 2e-5) << i;  // 2000 cells at 12 in 2^30

    const double across = std::floor(within(0, 64 * static_cast<double>(camera.width))),
                 down = std::floor(within(0, 64 * static_cast<double>(camera.height)));
    const double scale = std::tan(radians(camera.half_field)) / (32 * static_cast<double>(camera.height));
    Triple direction = along(forward, right, (across - 32 * static_cast<double>(camera.width)) * scale);
    direction = along(direction, up, (32 * static_cast<double>(camera.height) - down) * scale);

    const Ray ray = ray_through(view, static_cast<std::int64_t>(across), static_cast<std::int64_t>(down), 2);
    const double near = static_cast<double>(view.near) / 16;
    const double wide = std::sqrt(dot(direction, direction));
    // near_wide and near_high are rounded to 2^-30 cells, and up to 128000 of them are added.
    ASSERT_LT(distance(cells_of(ray.start), along(eye, direction, near)), 2e-4 * wide) << i;
    // A step is along the direction. Its part across is at most the rounding of three components.
    const Triple step = cells_of(ray.step);
    const double depth = dot(step, direction) / dot(direction, direction);
    ASSERT_LT(distance(step, along({}, direction, depth)), 1e-6) << i;
    ASSERT_GE(largest(ray.step), kCell / 8);
    ASSERT_LE(largest(ray.step), kCell / 4);
    // No corner of the grid is nearer than the plane on which the rays start, unless the eye itself is.
    for (int corner = 0; corner < 8 && view.near > 0; ++corner) {
      const Triple point{(corner & 1) != 0 ? 64.5 : -0.5, (corner & 2) != 0 ? 100.5 : -0.5,
                         (corner & 4) != 0 ? 128.5 : -0.5};
      ASSERT_GE(dot(along(point, eye, -1), forward), near) << i;
    }
  }
}

}  // namespace
}  // namespace voxmelt::picture
