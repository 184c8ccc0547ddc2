// The samples that a ray leaves out are compared with a plain walk through every sample: never one too many.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <random>

#include "hwmodel/caster/model/walk.h"

namespace voxmelt::hwmodel::raycast {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : random_(seed) {}
  std::int64_t below(std::int64_t n) {
    return static_cast<std::int64_t>(random_() % static_cast<unsigned>(n));
  }
  std::int64_t within(std::int64_t n) { return below(2 * n + 1) - n; }

 private:
  std::mt19937_64 random_;
};

// Makes a step of 2^-spacing cells. Its largest component in magnitude is more than half of that, or is it.
Vec random_step(Random& random, int spacing) {
  const std::int64_t most = std::int64_t{1} << (20 - spacing);
  std::array<std::int64_t, 3> values{};
  for (std::int64_t& one : values)
    one = random.below(4) == 0 ? 0 : random.within(random.below(3) == 0 ? 40 : most);
  const std::int64_t longest = most - random.below(most / 2);
  values[static_cast<std::size_t>(random.below(3))] = random.below(2) == 0 ? longest : -longest;
  return {values[0], values[1], values[2]};
}
Walker walker_at(Vec at, Vec step) {
  return {at, step, inverse_of(step.x), inverse_of(step.y), inverse_of(step.z)};
}

bool in_box(Vec p, Vec low, Vec high) {
  return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x < high.x && p.y < high.y && p.z < high.z;
}

TEST(RaycastWalk, NoSampleBeforeTheBoxIsInIt) {
  Random random(11);
  int hits = 0, misses = 0;
  for (int n = 0; n < 4000; ++n) {
    const auto corner = [&] { return random.below(6 << 20); };
    Vec low{corner(), corner(), corner()};
    const Vec high =
        low + Vec{1 + random.below(3 << 20), 1 + random.below(3 << 20), 1 + random.below(3 << 20)};
    const Vec step = random_step(random, 2 + n % 4);
    Vec start{random.within(9 << 20), random.within(9 << 20), random.within(9 << 20)};
    if (n % 2 == 0)
      start = low - step * random.below(600);  // it comes to a corner of the box, or close to it
    Walker walker = walker_at(start, step);
    std::int64_t first = -1;
    for (std::int64_t k = 0; k < 2400 && first < 0; ++k)
      if (in_box(walker.at + walker.step * k, low, high)) first = k;
    // The walk goes on until it is in the box, or knows that it never will be.
    std::int64_t k = 0;
    int leaps = 0;
    for (std::optional<std::int64_t> steps;
         (steps = steps_to_box(walker, low, high)) && *steps > 0 && k < 2400; ++leaps) {
      ASSERT_TRUE(first < 0 || k + *steps <= first) << n;
      k += *steps;
      walker.at = walker.at + walker.step * *steps;
    }
    if (first >= 0) {
      ASSERT_EQ(k, first) << n;
      ASSERT_LE(leaps, 4 + first / 100) << n;
      ++hits;
    } else {
      const auto steps = steps_to_box(walker, low, high);
      ASSERT_TRUE(!steps || k >= 2400) << n;
      misses += !steps ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(misses, 1000);
}

// Along an axis on which it does not move, a ray never comes to a box that it is not in.
TEST(RaycastWalk, ARayThatStandsStillOutsideOfTheBoxMissesItAtOnce) {
  const Vec low{1 << 20, 1 << 20, 1 << 20}, high{2 << 20, 2 << 20, 2 << 20};
  const std::int64_t inside = 3 << 19;
  for (const std::int64_t beside : {std::int64_t{0}, std::int64_t{2 << 20}}) {
    EXPECT_FALSE(steps_to_box(walker_at({beside, 0, 0}, {0, 1 << 18, 1 << 18}), low, high));
    EXPECT_FALSE(steps_to_box(walker_at({0, beside, 0}, {1 << 18, 0, 1 << 18}), low, high));
    EXPECT_FALSE(steps_to_box(walker_at({0, 0, beside}, {1 << 18, 1 << 18, 0}), low, high));
  }
  EXPECT_TRUE(steps_to_box(walker_at({inside, 0, inside}, {0, 1 << 18, 0}), low, high));
  EXPECT_EQ(steps_to_box(walker_at({inside, inside, inside}, {0, 1 << 18, 0}), low, high), 0);
}

std::int64_t blocks_away(Vec a, Vec b) {
  constexpr std::int64_t kBlock = std::int64_t{4} << 20;
  return std::max({std::abs(a.x / kBlock - b.x / kBlock), std::abs(a.y / kBlock - b.y / kBlock),
                   std::abs(a.z / kBlock - b.z / kBlock)});
}

TEST(RaycastWalk, NoSampleThatIsLeftOutIsReachBlocksAway) {
  Random random(12);
  for (int n = 0; n < 6000; ++n) {
    const std::int64_t reach = 1 + n % 16;
    const auto coordinate = [&] { return (std::int64_t{400} << 20) + random.below(4 << 20); };
    const Walker walker =
        walker_at({coordinate(), coordinate(), coordinate()}, random_step(random, 2 + n / 16 % 4));
    std::int64_t exact = 1;
    while (blocks_away(walker.at, walker.at + walker.step * exact) < reach) ++exact;
    const std::int64_t steps = steps_out(walker, reach);
    ASSERT_GE(steps, 1);
    ASSERT_LE(steps, exact) << n;
    ASSERT_GE(steps, exact - exact / 500 - 1) << n;
  }
}

// The walker stands at the last place before a side of the block, and on it.
TEST(RaycastWalk, StepsOutAtTheSidesOfABlock) {
  const std::int64_t block = std::int64_t{1} << 22, middle = 10 * block + block / 2;
  const auto out = [&](std::int64_t x, std::int64_t step, std::int64_t reach) {
    return steps_out(walker_at({x, middle, middle}, {step, 0, 0}), reach);
  };
  EXPECT_EQ(out(11 * block - 1, 1 << 18, 1), 1);
  EXPECT_EQ(out(10 * block, -(1 << 18), 1), 1);
  EXPECT_EQ(out(10 * block + 1, -(1 << 18), 1), 1);
  EXPECT_LE(out(10 * block, 1 << 18, 1), 16);  // sixteen quarters of a cell lead to the next block
  EXPECT_GE(out(10 * block, 1 << 18, 1), 15);
}

// A random block of levels has its bound of the slope by the page's words, and each sample in it is taken.
TEST(RaycastWalk, TheLevelDoesNotRiseToTheSurfaceInStepsThatAreLeftOut) {
  Random random(13);
  std::int64_t left_out = 0, close = 0;
  for (int n = 0; n < 4000; ++n) {
    std::array<std::array<std::array<std::int64_t, 5>, 5>, 5> levels{};  // [z][y][x]
    const std::int64_t rough = std::int64_t{1} << (4 + n % 12);
    const std::int64_t base = -random.below(20000), lean = random.within(rough);
    const bool straight =
        n % 3 == 0;  // uphill along the diagonal: the level rises as fast as the bound allows
    for (std::size_t z = 0; z < 5; ++z)
      for (std::size_t y = 0; y < 5; ++y)
        for (std::size_t x = 0; x < 5; ++x)
          levels[z][y][x] = std::clamp<std::int64_t>(
              base + lean * static_cast<std::int64_t>(x + y + z) + (straight ? 0 : random.within(rough)),
              -32640, 32640);
    std::array<std::int64_t, 3> most{};
    for (std::size_t a = 0; a < 5; ++a)
      for (std::size_t b = 0; b < 5; ++b)
        for (std::size_t c = 0; c < 4; ++c) {
          most[0] = std::max(most[0], std::abs(levels[a][b][c] - levels[a][b][c + 1]));
          most[1] = std::max(most[1], std::abs(levels[a][c][b] - levels[a][c + 1][b]));
          most[2] = std::max(most[2], std::abs(levels[c][a][b] - levels[c + 1][a][b]));
        }
    const std::int64_t slope = (most[0] + most[1] + most[2] + 767) / 768;
    const int spacing = 2 + n % 4;
    const Vec start{random.below(4 << 20), random.below(4 << 20), random.below(4 << 20)};
    const std::int64_t most_step = std::int64_t{1} << (20 - spacing),
                       uphill = lean < 0 ? -most_step : most_step;
    const Vec step = straight ? Vec{uphill, uphill, uphill} : random_step(random, spacing);
    const auto level = [&](Vec q) {
      std::array<std::int16_t, 8> values{};
      for (std::size_t i = 0; i < 8; ++i)
        values[i] = static_cast<std::int16_t>(levels[static_cast<std::size_t>(q.z >> 20) + (i >> 2)]
                                                    [static_cast<std::size_t>(q.y >> 20) + (i >> 1 & 1)]
                                                    [static_cast<std::size_t>(q.x >> 20) + (i & 1)]);
      return sample_of(values.data(), q);
    };
    const std::int64_t here = level(start);
    if (here >= 0) continue;
    const std::int64_t steps = steps_to_rise(here, slope, spacing);
    ASSERT_GE(steps, 1);
    for (std::int64_t k = 1; k <= steps; ++k) {
      const Vec q = start + step * k;
      if (!in_box(q, {}, {4 << 20, 4 << 20, 4 << 20})) break;
      const std::int64_t there = level(q);
      if (k == steps) {
        close += there >= 0 ? 1 : 0;
        break;
      }
      ASSERT_LT(there, 0) << n << ": sample " << k << " of " << steps;
      ++left_out;
    }
  }
  EXPECT_GT(left_out, 5000);
  EXPECT_GT(close, 5);  // the bound is not idle: some next sample is in matter
}

// The steepest level that a bound allows rises straight along an axis: by 768 slope a cell, from -level on.
TEST(RaycastWalk, TheSteepestRiseMeetsItsBound) {
  for (const std::int64_t slope : {1, 2, 7, 42, 80, 255})
    for (const int spacing : {2, 3, 4, 5})
      for (std::int64_t level = -1; level > -32640; level = 2 * level - 3) {
        const std::int64_t steps = steps_to_rise(level, slope, spacing);
        // In 1/8 of a level, this is the rise of steps - 1 steps, which is less than the margin of weights
        // and blends leaves.
        const std::int64_t rise = (steps - 1) * 768 * 8 * slope / (std::int64_t{1} << spacing);
        ASSERT_GE(steps, 1);
        ASSERT_TRUE(steps == 1 || rise + 8 * (3 * slope + 3) < -8 * level)
            << slope << " " << spacing << " " << level;
        // The steps are not a tenth fewer than they could be.
        const std::int64_t free = -level - 3 * slope - 4;
        ASSERT_GE(10 * (steps + 1) * 768 * slope, 9 * free * (std::int64_t{1} << spacing));
      }
}

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
