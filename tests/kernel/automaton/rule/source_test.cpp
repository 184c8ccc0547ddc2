// A point source moves between two keys (docs/automaton.md, "Visibility and irradiance"). The test goes up to
// the largest powers, distances and steps that a scene may name. The expected values are worked out by hand.
#include "kernel/automaton/rule/source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>

namespace voxmelt::rule {
namespace {

__extension__ typedef __int128 Wide;

constexpr std::uint32_t kLastStep = 0xFFFFFFFFu;
constexpr std::int64_t kFar = std::int64_t{1} << 24;  // sixteenths: the farthest position
constexpr std::int64_t kMostPower = (std::int64_t{1} << 50) - 1;

TEST(Between, FloorsBothSlopes) {
  EXPECT_EQ(between(0, 10, 1, 3), 3);
  EXPECT_EQ(between(10, 0, 1, 3), 6);  // 10 + floor(-10 / 3)
  EXPECT_EQ(between(-7, -8, 1, 2), -8);
  EXPECT_EQ(between(5, -5, 2, 4), 0);
  EXPECT_EQ(between(0, -1, 1, 1000), -1);
}

// Over n = 2^32 - 1 steps 2^50 - 1 is 2^18 n + 2^18 - 1. So each step goes 2^18 and less than 2^-14 farther.
TEST(Between, PowersOverAllSteps) {
  constexpr std::int64_t n = kLastStep, p18 = std::int64_t{1} << 18;
  EXPECT_EQ(between(0, kMostPower, 0, n), 0);
  EXPECT_EQ(between(0, kMostPower, 1, n), p18);
  EXPECT_EQ(between(0, kMostPower, n - 1, n), kMostPower - p18 - 1);
  EXPECT_EQ(between(kMostPower, 0, 0, n), kMostPower);
  EXPECT_EQ(between(kMostPower, 0, 1, n), kMostPower - p18 - 1);
  EXPECT_EQ(between(kMostPower, 0, n - 1, n), p18);
  // After half of n + 1 steps it is (2^50 - 1) / 2 + (2^50 - 1) / 2n = 2^49 - 1/2 + 2^17 + less than 1/2.
  EXPECT_EQ(between(0, kMostPower, (n + 1) / 2, n), (std::int64_t{1} << 49) + (std::int64_t{1} << 17) - 1);
}

// The source moves 2^25 sixteenths in 2^32 - 1 steps, which is 1/128 a step.
TEST(Between, PositionsOverAllSteps) {
  constexpr std::int64_t n = kLastStep;
  EXPECT_EQ(between(-kFar, kFar, 1, n), -kFar);
  EXPECT_EQ(between(-kFar, kFar, 127, n), -kFar);
  EXPECT_EQ(between(-kFar, kFar, 128, n), -kFar + 1);
  EXPECT_EQ(between(-kFar, kFar, n - 1, n), kFar - 1);
  EXPECT_EQ(between(kFar, -kFar, 1, n), kFar - 1);
  EXPECT_EQ(between(kFar, -kFar, 127, n), kFar - 1);
  EXPECT_EQ(between(kFar, -kFar, 128, n), kFar - 2);
  EXPECT_EQ(between(kFar, -kFar, n - 1, n), -kFar);
}

TEST(Between, IsTheFloorOf128Bits) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 200000; ++trial) {
    const auto a = static_cast<std::int64_t>(random() >> (14 + random() % 40)),
               b = static_cast<std::int64_t>(random() >> (14 + random() % 40));
    const auto n = static_cast<std::int64_t>(1 + (random() >> (32 + random() % 30)) % kLastStep),
               i = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(n));
    Wide quotient = Wide{b - a} * i / n;
    if (quotient * n > Wide{b - a} * i) --quotient;
    ASSERT_EQ(between(a, b, i, n), a + static_cast<std::int64_t>(quotient))
        << a << ", " << b << ", " << i << " of " << n;
  }
}

// Power 4194303 in the file is 4194303 x 2^28. With each step come 2^28 / 16384 = 2^14 of it.
TEST(SourceAt, GrowsToTheMostThatAFileMayName) {
  constexpr std::uint64_t most = std::uint64_t{4194303} << 28, each = std::uint64_t{4194303} << 14;
  const HeatSource source{{{0, {0, 0, 0}, 0}, {16384, {kFar, -kFar, 1}, most}}};
  for (const std::uint32_t step : {0u, 1u, 8191u, 8192u, 8193u, 16383u, 16384u, kLastStep})
    EXPECT_EQ(source_at(source, step).power, each * std::min(step, 16384u)) << "step " << step;
  const Position at = source_at(source, 8193).at;  // 8193 x 2^10; 8193 / 16384
  EXPECT_EQ(at.x, 8389632);
  EXPECT_EQ(at.y, -8389632);
  EXPECT_EQ(at.z, 0);
}

// (5 - 2) x 1 / 2 is 1.5, (-9 - 2) / 2 is -5.5, rounded down to -6, and 7 stays.
TEST(SourceAt, RadiusAndDirectionMoveToo) {
  const HeatSource source{
      {{.step = 1, .radius = 2, .direction = {2, 7, 0}}, {.step = 3, .radius = 5, .direction = {-9, 7, 4}}},
      SourceKind::sphere};
  const SourceKey middle = source_at(source, 2);
  EXPECT_EQ(middle.radius, 3);
  EXPECT_EQ(middle.direction.x, -4);
  EXPECT_EQ(middle.direction.y, 7);
  EXPECT_EQ(middle.direction.z, 2);
  EXPECT_EQ(source_at(source, 3).radius, 5);
}

TEST(SourceAt, ChoosesItsKeys) {
  const HeatSource source{{{4, {10, 0, 0}, 7}, {6, {20, 0, 0}, 1}, {10, {20, -4, 0}, 1}}};
  EXPECT_EQ(source_at(source, 0).power, 7u);
  EXPECT_EQ(source_at(source, 5).power, 4u);
  EXPECT_EQ(source_at(source, 5).at.x, 15);
  EXPECT_EQ(source_at(source, 6).power, 1u);
  EXPECT_EQ(source_at(source, 9).at.y, -3);
  EXPECT_EQ(source_at(source, 11).at.y, -4);
}

}  // namespace
}  // namespace voxmelt::rule
