// Rays meet planes and balls in analytic places, and as in a dense march in double.
#include "render/rule/crossing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "render/rule/angle.h"
#include "render/rule/camera.h"
#include "render/rule/fixed_point.h"
#include "render/rule/ground.h"
#include "render/rule/nearer.h"
#include "render/rule/normal.h"
#include "render/rule/ray.h"
#include "render/rule/sample.h"
#include "tests/render/rule/levels.h"

namespace voxmelt::picture {
namespace {

double cells(std::int64_t a) { return static_cast<double>(a) / static_cast<double>(kCell); }

TEST(Crossing, FalsePositionByHand) {
  EXPECT_EQ(false_position(-1, 1), 128);
  EXPECT_EQ(false_position(-1, 2), 85);  // 85.3, rounded down
  EXPECT_EQ(false_position(-5, 0), 256);
  EXPECT_EQ(false_position(-32640, 32640), 128);
  EXPECT_EQ(false_position(-1, 32640), 0);
}

// docs/picture/definition.md says that floats give the same quotient. For each divisor these are the
// dividends nearest below every whole quotient, where a float would be rounded up first.
TEST(Crossing, FalsePositionIsThatOfFloats) {
  for (std::int32_t divisor = 1; divisor <= 2 * kHalfIntensity; ++divisor)
    for (std::int32_t quotient = 1; quotient <= kParts; ++quotient) {
      const std::int32_t outside = -((quotient * divisor - 1) / kParts);
      if (outside < kAir || outside + divisor > kHalfIntensity || outside == 0) continue;
      const float by_float = static_cast<float>(-outside * kParts) / static_cast<float>(divisor);
      ASSERT_EQ(false_position(outside, outside + divisor), static_cast<std::int32_t>(by_float));
    }
}

// The centres of cells 0 and 1 have levels of -100 and 350. The middles 1, 3/4 and 5/8 have 125, 13 and -44
// (-43.25 rounded down after a half is added). Then f = 44 x 256 / 57 = 197 of an eighth of a cell.
TEST(Crossing, BetweenTwoCellsByHand) {
  const test::CubeOfLevels levels(2, [](int x, int, int) { return x == 0 ? -100 : 350; });
  const Ray ray{{kCell / 2, kCell / 2, kCell / 2}, {kCell, 0, 0}};
  const Crossing got = crossing_before(levels, ray, 1);
  EXPECT_EQ(got.position, (Vector{655360 + 100864, kCell / 2, kCell / 2}));
  EXPECT_EQ(got.part, 1 * 256 + 197);  // inside, inside, outside: the second of eight
}

// The levels are -100, 0, 0 and 100. As 0 is matter, the middles 2, 5/4 and 13/8 end as inside, outside,
// inside.
TEST(Crossing, LevelZeroIsMatter) {
  const test::CubeOfLevels levels(4, [](int x, int, int) { return x == 0 ? -100 : x == 3 ? 100 : 0; });
  const Ray ray{{kCell / 2, kCell / 2, kCell / 2}, {3 * kCell, 0, 0}};
  const Crossing got = crossing_before(levels, ray, 1);
  EXPECT_EQ(got.position, (Vector{13 * kCell / 8, kCell / 2, kCell / 2}));
  EXPECT_EQ(got.part, 2 * 256 + 256);  // inside, outside, inside, and all of that eighth
}

// A full grid is met on its side, from each direction, wherever the samples happen to lie.
TEST(Crossing, FullGridIsMetOnItsSide) {
  const test::CubeOfLevels full(8, [](int, int, int) { return kHalfIntensity; });
  for (std::int64_t offset = 0; offset < kCell; offset += 7919) {
    const Ray right{{-5 * kCell + offset, 4 * kCell, 4 * kCell}, {kCell / 4, 0, 0}};
    const Ray left{{13 * kCell + offset, 4 * kCell, 4 * kCell}, {-kCell / 4, 0, 0}};
    const Crossing near = first_crossing(full, full.cells(), right);
    const Crossing far = first_crossing(full, full.cells(), left);
    ASSERT_TRUE(near.found && far.found);
    // Weights are to the nearest 512th of a cell, and the level is even, so the place is as exact.
    ASSERT_NEAR(cells(near.position.x), 0, 1.0 / 400);
    ASSERT_NEAR(cells(far.position.x), 8, 1.0 / 400);
    ASSERT_EQ(near.position.y, 4 * kCell);
  }
}

// Every number of the worked ray of docs/picture/definition.md, section 11, is by hand.
TEST(Crossing, TheWorkedRay) {
  const test::CubeOfLevels full(64, [](int, int, int) { return kHalfIntensity; });
  const Camera camera{{32 * kCell, 32 * kCell, 64 * kCell}, 100 << 12, 0, 0, 45 * kDegree, 8, 4};
  const View view = view_of(camera, full.cells());
  const Ray ray = ray_through(view, 256, 128, 2);
  EXPECT_EQ(view.near, 1589);
  EXPECT_EQ(view.halvings, 0);
  EXPECT_EQ(ray.start.z, 67829760);
  EXPECT_EQ(ray.step, (Vector{0, 0, -262144}));
  EXPECT_EQ(samples_in(ray, field_low(), field_high(full.cells())).first, 1);
  const std::int32_t samples[] = {-28560, -12240, 4080};
  for (int k = 1; k <= 3; ++k) EXPECT_EQ(sample(full, ray.at(k)), samples[k - 1]);
  EXPECT_EQ(place_of(ray.at(1).z).cell, 63);
  EXPECT_EQ(place_of(ray.at(1).z).weight, 240);
  EXPECT_EQ(sample(full, ray.at(2) + Vector{0, 0, -131072}), -4080);
  EXPECT_EQ(sample(full, ray.at(2) + Vector{0, 0, -196608}), 0);
  EXPECT_EQ(sample(full, ray.at(2) + Vector{0, 0, -163840}), -2040);
  const Crossing got = first_crossing(full, full.cells(), ray);
  EXPECT_EQ(got.sample, 3);
  EXPECT_EQ(got.position, (Vector{33554432, 33554432, 67108864}));
  EXPECT_EQ(normal_at(full, got.position), (Vector{0, 0, 16384}));
  EXPECT_EQ(depth_in_picture(view, got.position), 22);
}

// With sample 3 and part 100, matter is at 2 x 2048 + 100 = 4196. The top shows up to there, and a side 1024
// later or as far in halved steps. Places of the ground are eighths of that.
TEST(Nearer, SidesWinByTheSameLength) {
  const auto first = [](Face face, std::int64_t part, int halvings) {
    return ground_first({true, part, {}, face}, {true, 3, 100, {}}, halvings);
  };
  EXPECT_TRUE(first(Face::top, 524, 2));  // 4192
  EXPECT_FALSE(first(Face::top, 525, 2));
  const std::int64_t last[] = {652, 780, 1036};  // 5220, 6244 and 8292 in eighths
  for (int halvings = 0; halvings < 3; ++halvings) {
    EXPECT_TRUE(first(Face::low_x, last[halvings], halvings));
    EXPECT_FALSE(first(Face::low_x, last[halvings] + 1, halvings));
  }
}

TEST(Crossing, NothingIsMetInAir) {
  const test::CubeOfLevels empty(8, [](int, int, int) { return kAir; });
  EXPECT_FALSE(first_crossing(empty, empty.cells(), {{0, 0, 0}, {kCell / 4, kCell / 8, kCell / 4}}).found);
}

TEST(Crossing, ARayThatStartsInMatterMeetsItThere) {
  const test::CubeOfLevels full(8, [](int, int, int) { return kHalfIntensity; });
  const Ray ray{{kCell, kCell, kCell}, {kCell / 4, 0, 0}};
  const Crossing got = first_crossing(full, full.cells(), ray);
  EXPECT_TRUE(got.found);
  EXPECT_EQ(got.sample, 0);
  EXPECT_EQ(got.position, ray.start);
}

// The same samples are taken in double: first a march in 256ths of a step, then a comparison of the places.
TEST(Crossing, IsThatOfADenseMarchInDouble) {
  const test::CubeOfLevels ball = test::ball_of_levels(24, 8);
  std::mt19937 random(3);
  std::uniform_int_distribution<std::int64_t> place(4 * kCell, 20 * kCell);
  int met = 0;
  for (int i = 0; i < 400; ++i) {
    const Vector from{place(random), place(random), -3 * kCell}, to{place(random), place(random), 27 * kCell};
    const Ray ray{from, step_along(to - from, 2)};
    const Crossing got = first_crossing(ball, ball.cells(), ray);
    const double most = 30 * 8 * 2;  // samples beyond the far side
    double crossing = -1, deepest = kAir;
    for (double k = 0; k < most && crossing < 0; k += 1.0 / 256) {
      const double level =
          test::plain_sample(ball, cells(from.x) + k * cells(ray.step.x),
                             cells(from.y) + k * cells(ray.step.y), cells(from.z) + k * cells(ray.step.z));
      deepest = std::max(deepest, level);
      if (level >= 0) crossing = k;
    }
    // A chord of less than two samples may be missed: its ray only touches the ball.
    if (crossing >= 0 && !got.found) {
      const double x = cells(to.x - from.x), y = cells(to.y - from.y), z = cells(to.z - from.z);
      const double px = cells(from.x) - 12, py = cells(from.y) - 12, pz = cells(from.z) - 12;
      const double across =
          std::hypot(py * z - pz * y, pz * x - px * z, px * y - py * x) / std::hypot(x, y, z);
      EXPECT_GT(across, 7.9) << i;
      continue;
    }
    ASSERT_EQ(crossing >= 0, got.found) << i;
    if (!got.found) continue;
    ++met;
    const double at = cells(got.position.z - from.z) / cells(ray.step.z);
    const double length = std::hypot(cells(ray.step.x), cells(ray.step.y), cells(ray.step.z));
    // Along the normal, the angle between ray and surface takes its share.
    const double nx = cells(got.position.x) - 12, ny = cells(got.position.y) - 12,
                 nz = cells(got.position.z) - 12;
    const double cosine = std::abs(nx * cells(ray.step.x) + ny * cells(ray.step.y) + nz * cells(ray.step.z)) /
                          (length * std::hypot(nx, ny, nz));
    EXPECT_NEAR((at - crossing) * length * cosine, 0, 1.0 / 256) << i;
  }
  EXPECT_GT(met, 150);
}

}  // namespace
}  // namespace voxmelt::picture
