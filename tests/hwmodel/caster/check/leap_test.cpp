// The longest leap that the checker allows is compared with a plain count over the samples.
#include "hwmodel/caster/check/leap_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "tests/kernel/worlds.h"

namespace voxmelt::hwmodel::raycast {
namespace {

constexpr std::int64_t kCellUnits = std::int64_t{1} << 20, kBlockUnits = 4 * kCellUnits;

Vec any_vec(worlds::Random& random, int low, int high) {
  return {random.between(low, high), random.between(low, high), random.between(low, high)};
}
std::array<std::int64_t, 3> axes(Vec v) { return {v.x, v.y, v.z}; }

// Makes a map of 20 x 20 x 20 blocks with the same word in all of them.
SkipMap same_everywhere(std::uint16_t word) {
  const std::int64_t end = 20 * kBlockUnits;
  return {20, 20, 20, std::vector<std::uint16_t>(20 * 20 * 20, word), {}, {end, end, end}};
}

TEST(Leaps, GoAsFarAsTheBlocksThatAreEmpty) {
  worlds::Random random(41);
  for (int n = 0; n < 2000; ++n) {
    const int reach = random.between(1, 6);
    const SkipMap skip = same_everywhere(static_cast<std::uint16_t>(256 + reach));
    const Vec at = any_vec(random, 10 * kBlockUnits, 11 * kBlockUnits - 1);
    Vec step = any_vec(random, -kCellUnits / 4, kCellUnits / 4);
    if (n % 3 == 0) step.x = 0;
    const auto near = [&](std::int64_t k) {
      const Vec q = at + step * k;
      const auto a = axes(at), b = axes(q);
      return std::equal(a.begin(), a.end(), b.begin(), [&](std::int64_t p, std::int64_t r) {
        return std::abs(p / kBlockUnits - r / kBlockUnits) < reach;
      });
    };
    std::int64_t first = 1;
    while (near(first) && first < 100'000) ++first;
    ASSERT_EQ(std::min<std::int64_t>(100'000, longest_leap(skip, 2, Leap::out_of_block, {at, step})), first)
        << n;
  }
}

// Before the box, some axis keeps all samples on one side of it. A ray beside the box may go for ever.
TEST(Leaps, GoAsFarAsTheBoxLiesAhead) {
  worlds::Random random(42);
  int ahead = 0;
  for (int n = 0; n < 2000; ++n) {
    SkipMap skip = same_everywhere(1);
    skip.low = any_vec(random, 4 * kBlockUnits, 9 * kBlockUnits);
    skip.high = skip.low + any_vec(random, 1, 3 * kBlockUnits);
    const Vec at = any_vec(random, 0, 15 * kBlockUnits), step = any_vec(random, -kCellUnits, kCellUnits);
    std::int64_t outside = 0;
    for (std::size_t a = 0; a < 3; ++a)
      for (const bool below : {true, false}) {
        std::int64_t k = 0;
        const auto on_side = [&] {
          const std::int64_t q = axes(at + step * k)[a];
          return below ? q < axes(skip.low)[a] : q >= axes(skip.high)[a];
        };
        while (on_side() && k < 100'000) ++k;
        outside = std::max(outside, k);
      }
    ahead += outside > 0 && outside < 100'000 ? 1 : 0;
    ASSERT_EQ(std::min<std::int64_t>(100'000, longest_leap(skip, 2, Leap::to_box, {at, step})), outside) << n;
  }
  EXPECT_GT(ahead, 100);
}

// By hand: with slope 2 and steps of a quarter of a cell, a level rises by 384 a step. Roundings take 9 of
// it, and what is left out must be below 0.
TEST(Leaps, LeaveOutNoLevelThatMayBeMatter) {
  const SkipMap skip = same_everywhere(2);
  const Vec middle{10 * kBlockUnits, 10 * kBlockUnits, 10 * kBlockUnits};
  const auto leap = [&](std::int64_t level) {
    return longest_leap(skip, 2, Leap::through_air, {middle, {kCellUnits / 4, 0, 0}, level});
  };
  EXPECT_EQ(leap(-1), 1);
  EXPECT_EQ(leap(-393), 1) << "after a step the level may be -393 + 384 + 9 = 0";
  EXPECT_EQ(leap(-394), 2);
  EXPECT_EQ(leap(-777), 2);
  EXPECT_EQ(leap(-778), 3);
  EXPECT_EQ(leap(-32640), 16) << "the block ends after 16 steps";
}

TEST(Leaps, AreOfNoBlockThatDoesNotAllowThem) {
  const SampleOnRay in_map{{kBlockUnits, kBlockUnits, kBlockUnits}, {1, 1, 1}, -30000},
      beyond{{-1, 0, 0}, {1, 0, 0}, -30000};
  EXPECT_EQ(longest_leap(same_everywhere(7), 2, Leap::out_of_block, in_map), 0) << "it holds matter";
  EXPECT_EQ(longest_leap(same_everywhere(260), 2, Leap::through_air, in_map), 0) << "it has no slope";
  for (const Leap why : {Leap::out_of_block, Leap::through_air})
    EXPECT_EQ(longest_leap(same_everywhere(260), 2, why, beyond), 0) << "there is no block";
}

// The same bound and slopes hold for 64 x 64 fine blocks.
GroundBlocks ground_everywhere(GroundBlock block, std::int32_t coarse) {
  GroundBlocks blocks;
  blocks.x = blocks.z = 64;
  blocks.fine.assign(64 * 64, block);
  blocks.coarse.assign(16 * 16, coarse);
  return blocks;
}

// All samples before the longest leap lie above the bound, in the block in which the ray is.
TEST(Leaps, OverGroundStayAboveAllThatABlockHolds) {
  worlds::Random random(43);
  int long_ones = 0;
  for (int n = 0; n < 2000; ++n) {
    const std::int64_t highest = random.between(1, 300), height = highest << 14;
    const bool coarse = n % 2 == 0;  // else the coarse block reaches the sky
    const GroundBlocks blocks = ground_everywhere({static_cast<std::int32_t>(highest), 0, 0},
                                                  coarse ? static_cast<std::int32_t>(highest) : 1 << 16);
    const std::int64_t side = coarse ? 16 * kCellUnits : 4 * kCellUnits;
    Vec at = any_vec(random, 100 * kCellUnits, 101 * kCellUnits),
        step = any_vec(random, -kCellUnits / 4, kCellUnits / 4);
    at.y = height + random.between(-1000, 4 * kCellUnits);
    const auto above = [&](std::int64_t k) {
      const Vec q = at + step * k;
      return q.y >= height && q.x / side == at.x / side && q.z / side == at.z / side;
    };
    std::int64_t first = 0;
    while (above(first) && first < 100'000) ++first;
    long_ones += first > 5;
    ASSERT_EQ(std::min<std::int64_t>(100'000, longest_leap(blocks, Leap::over_blocks, {at, at, step})), first)
        << n;
  }
  EXPECT_GT(long_ones, 200);
}

// By hand: the ground rises by 1 cell a cell along x, and a ray comes nearer by 1/4 of a cell a sample, which
// is 1024 of 2^-12 cells. Roundings take 4 of them, and 2 x 4096 / 512 = 16 more.
TEST(Leaps, OverGroundStayAboveItsSlopes) {
  const GroundBlocks blocks = ground_everywhere({1 << 16, 64, 0}, 1 << 16);
  const Vec west{100 * kCellUnits, 90 * kCellUnits, 100 * kCellUnits};
  const auto leap = [&](std::int64_t above, Vec step) {
    return longest_leap(blocks, Leap::over_slopes, {west, west, step, above});
  };
  const Vec level{kCellUnits / 4, 0, 0}, up{kCellUnits / 4, kCellUnits / 4, 0};
  EXPECT_EQ(leap(-1, level), 0) << "it lies in the ground";
  EXPECT_EQ(leap(20, level), 1);
  EXPECT_EQ(leap(20 + 1023, level), 1);
  EXPECT_EQ(leap(20 + 1024, level), 2);
  EXPECT_EQ(leap(20 + 2048, level), 3);
  EXPECT_EQ(leap(20 + 900 * 1024, level), 16) << "the block ends";
  EXPECT_EQ(leap(0, up), 16) << "it never comes nearer";
}

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
