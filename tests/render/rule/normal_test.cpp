// Unit vectors and normals are tested by hand, and against double.
#include "render/rule/normal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include "render/rule/fixed_point.h"
#include "tests/render/rule/levels.h"

namespace voxmelt::picture {
namespace {

TEST(Normal, SquareRootIsRoundedDown) {
  for (std::int64_t i = 0; i < 3000; ++i) {
    EXPECT_EQ(square_root(i * i), i);
    EXPECT_EQ(square_root(i * i + 2 * i), i);
  }
  EXPECT_EQ(square_root((std::int64_t{1} << 40) - 1), (std::int64_t{1} << 20) - 1);
}

TEST(Normal, TableIsThatOfDouble) {
  for (std::size_t i = 0; i < kInverseRoot.size(); ++i)
    EXPECT_EQ(kInverseRoot[i], std::lround(32768 / std::sqrt(static_cast<double>(i + 128) / 128))) << i;
}

TEST(Normal, UnitVectorsByHand) {
  EXPECT_EQ(unit({0, 0, 0}), (Vector{0, 0, 0}));
  EXPECT_EQ(unit({1, 0, 0}), (Vector{16384, 0, 0}));
  EXPECT_EQ(unit({0, -32640, 0}), (Vector{0, -16384, 0}));
  EXPECT_EQ(unit({300, 0, -400}), (Vector{9830, 0, -13107}));        // 3 4 5
  EXPECT_EQ(unit({200, 100, -200}), (Vector{10923, 5461, -10923}));  // 2 1 2, of length 3
}

// The line between entries errs by 6e-6 at most, an entry by half in 2^14, and the result by half in 2^14.
TEST(Normal, UnitVectorsAreThoseOfDouble) {
  std::mt19937 random(8);
  for (int i = 0; i < 200000; ++i) {
    std::uniform_int_distribution<std::int64_t> component(-(32640 >> i % 12), 32640 >> i % 12);
    const Vector a{component(random), component(random), component(random)};
    if (a == Vector{}) continue;
    const double x = static_cast<double>(a.x), y = static_cast<double>(a.y), z = static_cast<double>(a.z);
    const double scale = 16384 / std::hypot(x, y, z);
    const Vector got = unit(a);
    ASSERT_NEAR(static_cast<double>(got.x), x * scale, 1.6) << i;
    ASSERT_NEAR(static_cast<double>(got.y), y * scale, 1.6) << i;
    ASSERT_NEAR(static_cast<double>(got.z), z * scale, 1.6) << i;
  }
}

TEST(Normal, SidesOfAFullGrid) {
  const test::CubeOfLevels full(8, [](int, int, int) { return kHalfIntensity; });
  EXPECT_EQ(normal_at(full, {0, 4 * kCell, 4 * kCell}), (Vector{-16384, 0, 0}));
  EXPECT_EQ(normal_at(full, {4 * kCell, 8 * kCell, 4 * kCell}), (Vector{0, 16384, 0}));
  EXPECT_EQ(normal_at(full, {4 * kCell, 4 * kCell, 4 * kCell}), (Vector{0, 0, 0}));
}

TEST(Normal, OfABallPointsOutward) {
  const test::CubeOfLevels ball = test::ball_of_levels(24, 8);
  std::mt19937 random(9);
  std::normal_distribution<double> any;
  for (int i = 0; i < 1000; ++i) {
    const double x = any(random), y = any(random), z = any(random), length = std::hypot(x, y, z);
    const auto on_ball = [&](double a) {
      return static_cast<std::int64_t>((12 + 8 * a / length) * static_cast<double>(kCell));
    };
    const Vector n = normal_at(ball, {on_ball(x), on_ball(y), on_ball(z)});
    const double cosine =
        (static_cast<double>(n.x) * x + static_cast<double>(n.y) * y + static_cast<double>(n.z) * z) /
        (16384 * length);
    EXPECT_GT(cosine, std::cos(0.03)) << i;  // 1.7 degrees
  }
}

}  // namespace
}  // namespace voxmelt::picture
