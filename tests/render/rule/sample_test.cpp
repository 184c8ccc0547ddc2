// Places, weights and interpolation are tested by hand, and against a double interpolation.
#include "render/rule/sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "render/rule/fixed_point.h"
#include "tests/render/rule/levels.h"

namespace voxmelt::picture {
namespace {

TEST(Sample, PlacesByHand) {
  const auto is = [](std::int64_t position, std::int64_t cell, std::int32_t weight) {
    EXPECT_EQ(place_of(position).cell, cell) << position;
    EXPECT_EQ(place_of(position).weight, weight) << position;
  };
  is(kCell / 2, 0, 0);         // a centre
  is(kCell, 0, 128);           // between two
  is(0, -1, 128);              // on the side of the grid
  is(kCell / 2 + 2047, 0, 0);  // just below half of a 256th
  is(kCell / 2 + 2048, 0, 1);  // half of a 256th counts up
  is(kCell / 2 - 2048, 0, 0);
  is(kCell / 2 - 2049, -1, 255);  // the nearest is still below the centre
}

TEST(Sample, PrefilterByHand) {
  EXPECT_EQ(prefiltered(65280, 65280, 65280), 65280);
  EXPECT_EQ(prefiltered(0, 0, 0), 0);
  EXPECT_EQ(prefiltered(0, 256, 0), 170);
  EXPECT_EQ(prefiltered(256, 0, 0), 43);
  EXPECT_EQ(prefiltered(0, 0, 2), 0);  // 86 / 256 and a half
  EXPECT_EQ(prefiltered(0, 0, 3), 1);  // 129 / 256 and a half
}

TEST(Sample, BlendRoundsToNearest) {
  EXPECT_EQ(blended(10, 20, 0), 10);
  EXPECT_EQ(blended(10, 20, 255), 20);  // 19.96
  EXPECT_EQ(blended(0, 1, 127), 0);
  EXPECT_EQ(blended(0, 1, 128), 1);  // halves upwards
  EXPECT_EQ(blended(0, -1, 128), 0);
  EXPECT_EQ(blended(-32640, 32640, 128), 0);
}

// The field is linear in each coordinate: 100 x + 10 y + 1000 z at the centres.
TEST(Sample, LinearFieldByHand) {
  const test::CubeOfLevels levels(4, [](int x, int y, int z) { return 100 * x + 10 * y + 1000 * z; });
  EXPECT_EQ(sample(levels, {kCell / 2, kCell / 2, kCell / 2}), 0);
  EXPECT_EQ(sample(levels, {2 * kCell, kCell + kCell / 2, 2 * kCell + kCell / 4}), 150 + 10 + 1750);
  EXPECT_EQ(sample(levels, {3 * kCell + kCell / 2, 3 * kCell + kCell / 2, 3 * kCell + kCell / 2}), 3330);
}

// Each of the three blends rounds by at most 1/2, so with the same weights the double is within 3/2. The
// result is never outside the levels around, which lets a skip by ranges change nothing.
TEST(Sample, IsWithinOneAndAHalfOfTheDouble) {
  std::mt19937 random(6);
  std::uniform_int_distribution<std::int32_t> level(-kHalfIntensity, kHalfIntensity);
  const test::CubeOfLevels levels(5, [&](int, int, int) { return level(random); });
  std::uniform_int_distribution<std::int64_t> place(-kCell / 2, 5 * kCell + kCell / 2 - 4096);
  for (int i = 0; i < 100000; ++i) {
    const Vector at{place(random), place(random), place(random)};
    const auto exact = [](std::int64_t a) {  // place of the nearest weights
      const Place p = place_of(a);
      return static_cast<double>(p.cell) + 0.5 + p.weight / 256.0;
    };
    const std::int32_t got = sample(levels, at);
    ASSERT_NEAR(got, test::plain_sample(levels, exact(at.x), exact(at.y), exact(at.z)), 1.5 + 1e-9) << i;
    const auto off = [&](std::int64_t a) {
      return std::abs(exact(a) - static_cast<double>(a) / static_cast<double>(kCell));
    };
    ASSERT_LE(std::max({off(at.x), off(at.y), off(at.z)}), 1.0 / 512) << i;
    std::int32_t low = kHalfIntensity, high = -kHalfIntensity;
    for (int corner = 0; corner < 8; ++corner) {
      const std::int32_t here =
          levels(place_of(at.x).cell + (corner & 1), place_of(at.y).cell + (corner >> 1 & 1),
                 place_of(at.z).cell + (corner >> 2));
      low = std::min(low, here);
      high = std::max(high, here);
    }
    ASSERT_TRUE(low <= got && got <= high) << i;
  }
}

// The last position in the box still sees a cell of the grid. The next one sees air alone.
TEST(Sample, BoxEndsWhereAllIsAir) {
  const test::CubeOfLevels full(2, [](int, int, int) { return kHalfIntensity; });
  const Vector middle{kCell, kCell, kCell}, low = field_low(), high = field_high(full.cells());
  EXPECT_EQ(place_of(low.x).cell, -1);
  EXPECT_EQ(place_of(low.x - 1).cell, -2);
  EXPECT_EQ(place_of(high.x - 1).cell, 1);
  EXPECT_EQ(place_of(high.x).cell, 2);
  EXPECT_EQ(sample(full, {low.x - 1, middle.y, middle.z}), kAir);
  EXPECT_EQ(sample(full, {high.x, middle.y, middle.z}), kAir);
  EXPECT_GT(sample(full, {high.x - 1, middle.y, middle.z}), kAir);
  EXPECT_EQ(sample(full, {0, middle.y, middle.z}), 0);  // the surface of a full grid is its side
}

}  // namespace
}  // namespace voxmelt::picture
