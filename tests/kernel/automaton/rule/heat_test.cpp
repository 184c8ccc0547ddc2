// The bounds of heat (docs/proofs.md) hold for the real functions.
#include "kernel/automaton/rule/heat.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

namespace voxmelt::rule {
namespace {

// Returns the heat that the phase adds to a cell whose 2 `axes` neighbours are all `other`, pair by pair.
std::int32_t gain(std::int32_t own, std::int32_t other, std::int32_t weight, std::uint32_t step, int axes) {
  std::int32_t sum = 0;
  for (int k = 0; k < axes; ++k) {
    const std::int32_t r = dither(step, k, axes);
    sum += conducted(own, other, weight, r) - conducted(other, own, weight, r);
  }
  return sum;
}

// Returns the step where the dithers cover the circular interval [-r, r) best: one dither is at its begin.
std::uint32_t worst_step(std::int32_t r, int k, int axes) {
  return static_cast<std::uint32_t>(
      dither(static_cast<std::uint32_t>((2 * 65536 - r - 65536 * k / axes) % 65536)));
}

struct Pass {
  int axes;
  std::int32_t weight;
};
constexpr std::array<Pass, 3> kPasses{{{3, 10922}, {6, 5461}, {4, 3640}}};

TEST(Glow, GoesWithTheFourthPower) {
  EXPECT_EQ(fourth_power(0), 0);
  EXPECT_EQ(fourth_power(32768), 4096);   // 1/16 of 65536
  EXPECT_EQ(fourth_power(65535), 65532);  // 65534 squared is 65532.00006 x 65536
  // A corner has 6/4 of 10922, 16383: -65532 x 16383 / 65536 is -16382.00006, and D rounds it up.
  EXPECT_EQ(glowed(65535, 65535, 0, 10922, 3, 0), -16383);
  EXPECT_EQ(glowed(65535, 65535, 0, 10922, 3, 65535), -16382);
  EXPECT_EQ(glowed(0, 0, 65535, 10922, 1, 0), 10921);
  EXPECT_EQ(glowed(65530, 65530, 65535, 10922, 3, 65535), 5);  // 20 x 1/4, and no more than there is room for
  // Latent heat keeps the temperature at the melting point.
  EXPECT_EQ(temperature_of(40000, {.melting_point = 32768, .latent_heat = 20000}), 32768);
  EXPECT_EQ(glowed(40000, 32768, 0, 10922, 1, 0), -683);
}

// It brings a cell no further than to the temperature of what it glows at, but for one unit.
TEST(Glow, StaysBetween) {
  for (const int sky : {0, 1, 777, 32768, 65000, 65535})
    for (int h = 0; h <= 65535; ++h)
      for (const int offset : {0, 65535}) {
        const int after = h + glowed(h, h, sky, 10922, 3, offset);
        ASSERT_GE(after, std::max(0, std::min(h, sky) - 1)) << h << ", sky " << sky;
        ASSERT_LE(after, std::min(65535, std::max(h, sky) + 1)) << h << ", sky " << sky;
      }
}

TEST(Freeze, WhatIsColdAndFull) {
  const Material wax{.melting_point = 30000, .freezing_point = 29000};
  EXPECT_TRUE(is_cold(28999, wax));
  EXPECT_FALSE(is_cold(29000, wax));
  EXPECT_FALSE(is_cold(0, {.melting_point = 30000})) << "0 is off";
  EXPECT_TRUE(is_full(4032));
  EXPECT_FALSE(is_full(4031));
}

TEST(Conduction, WorstStepIsTheWorst) {
  for (const Pass pass : kPasses)
    for (const std::int32_t u : {1, 2, 3, 5, 6, 7, 11, 12, 13, 1000, 65535}) {
      const std::int32_t r = static_cast<std::int32_t>(std::int64_t{u} * pass.weight % 65536);
      std::int32_t largest = 0, predicted = 0;
      for (std::uint32_t s = 0; s < 65536; ++s)
        largest = std::max(largest, -gain(u, 0, pass.weight, s, pass.axes));
      for (int k = 0; k < pass.axes; ++k)
        predicted = std::max(predicted, -gain(u, 0, pass.weight, worst_step(r, k, pass.axes), pass.axes));
      EXPECT_EQ(largest, predicted) << pass.axes << " axes, U = " << u;
    }
}

// Every difference U meets the step that is worst for it. A cell never passes its neighbours, up or down.
TEST(Conduction, NeverPassesItsNeighbours) {
  for (const Pass pass : kPasses)
    for (std::int32_t u = 1; u <= 65535; ++u) {
      const std::int32_t r = static_cast<std::int32_t>(std::int64_t{u} * pass.weight % 65536);
      for (int k = 0; k < pass.axes; ++k) {
        const std::uint32_t s = worst_step(r, k, pass.axes);
        ASSERT_LE(-gain(u, 0, pass.weight, s, pass.axes), u)
            << pass.axes << " axes, U = " << u << ", step " << s;
        ASSERT_LE(gain(0, u, pass.weight, s, pass.axes), u)
            << pass.axes << " axes, U = " << u << ", step " << s;
      }
    }
}

// The same holds for all weights up to the bound at once. With U w = 65536 k + r, 2 n w <= B: U >= 2 n k +
// ceil(2 n r / B). So it is enough that no step covers [-r, r) more than ceil(2 n r / B) times, for every r.
TEST(Conduction, HoldsForEverySmallerWeight) {
  for (const Pass pass : kPasses) {
    const int n = pass.axes;
    const std::int32_t b = 2 * n * pass.weight;
    ASSERT_LE(b, 65532);
    for (std::int32_t r = 0; r < 65536; ++r)
      for (int first = 0; first < n; ++first) {
        int covered = 0;
        for (int k = 0; k < n; ++k) {
          const std::int32_t at = dither(worst_step(r, first, n), k, n);
          covered += (at < r) + (at >= 65536 - r);
        }
        ASSERT_LE(covered, (2 * n * r + b - 1) / b) << n << " axes, r = " << r;
      }
  }
}

TEST(Conduction, OneMoreBreaksIt) {
  // These values are at both ends of the range, where 16 bits could wrap.
  bool below_zero = false, above_full = false;
  for (std::int32_t u = 1; u <= 65535; ++u)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t s = worst_step(static_cast<std::int32_t>(u * 10923LL % 65536), k, 3);
      below_zero = below_zero || u + gain(u, 0, 10923, s, 3) < 0;
      above_full = above_full || 65535 - u + gain(65535 - u, 65535, 10923, s, 3) > 65535;
    }
  EXPECT_TRUE(below_zero);
  EXPECT_TRUE(above_full);

  // The edges' bound is as sharp.
  bool edges = false;
  for (std::int32_t u = 1; u <= 65535; ++u)
    for (int k = 0; k < 6; ++k)
      edges = edges ||
              u + gain(u, 0, 5462, worst_step(static_cast<std::int32_t>(u * 5462LL % 65536), k, 6), 6) < 0;
  EXPECT_TRUE(edges);
}

// With latent heat T is monotone and 1-Lipschitz, so the bounds for T hold for h.
TEST(Latent, TemperatureIsMonotoneAndFlatter) {
  for (const std::int32_t tm : {0, 1, 32768, 65535})
    for (const std::int32_t latent : {0, 1, 20000, 65535}) {
      if (tm + latent > 65535) continue;
      const Material m{static_cast<Temperature>(tm), static_cast<Temperature>(latent)};
      for (std::int32_t h = 0; h < 65535; ++h) {
        const std::int32_t rise = temperature_of(h + 1, m) - temperature_of(h, m);
        ASSERT_TRUE(rise == 0 || rise == 1) << tm << ' ' << latent << ' ' << h;
        ASSERT_EQ(melts(h, m), h >= tm + latent);
      }
      EXPECT_EQ(temperature_of(0, m), 0);
      EXPECT_EQ(temperature_of(tm, m), tm);
      EXPECT_EQ(temperature_of(tm + latent, m), tm);
    }
}

TEST(Convection, GivesUpwardsAtMostTheDifference) {
  for (std::int32_t u = 0; u <= 65535; ++u)
    for (const std::int32_t w : {0, 1, 32767})
      for (const std::int32_t r : {0, 1, 65535}) {  // monotone in w and r: the corners are the worst
        const std::int32_t up = convected(u, 0, w, r);
        ASSERT_TRUE(up >= 0 && up <= u) << u << ' ' << w << ' ' << r;
        ASSERT_EQ(convected(0, u, w, r), 0);
        ASSERT_EQ(convected(65535, 65535 - u, w, r), up);
      }
}

// By hand: 4/4, 5/4 and 6/4 of 1000 and of 1001.
TEST(Exchange, GoesByTheAreaOfADigitalSurface) {
  EXPECT_EQ(exposed_exchange(1000, 1), 1000);
  EXPECT_EQ(exposed_exchange(1000, 2), 1250);
  EXPECT_EQ(exposed_exchange(1001, 2), 1251);
  EXPECT_EQ(exposed_exchange(1001, 3), 1501);
}

// Planes of all directions are made of cells, height by height. Each of their cells counts by its exposed
// axes. Over all directions the sum is the area of the plane, as docs/decisions/area-of-air.md says.
TEST(Exchange, TheAreaIsUnbiasedOverAllDirections) {
  constexpr int kSide = 60, kTurns = 24;
  double sum = 0, least = 9, most = 0, weights = 0;
  for (int i = 0; i < kTurns; ++i)
    for (int j = 0; j < kTurns; ++j) {
      // The normal (b, 1, c) has its largest part along the height: a pyramid over a sixth of all directions.
      const double b = (i + 0.37) / kTurns, c = (j + 0.61) / kTurns, length = std::sqrt(1 + b * b + c * c);
      const auto height = [&](int x, int z) { return static_cast<int>(std::floor(1000 - b * x - c * z)); };
      double area = 0;
      for (int x = 1; x <= kSide; ++x)
        for (int z = 1; z <= kSide; ++z) {
          const int top = height(x, z), right = height(x + 1, z), front = height(x, z + 1);
          for (int y = top; y > std::min({top - 1, right, front}); --y)
            area += exposed_exchange(4096, (y == top) + (y > right) + (y > front)) / 4096.0;
        }
      const double ratio = area / (kSide * kSide * length), weight = 1 / (length * length * length);
      sum += weight * ratio;
      weights += weight;
      least = std::min(least, ratio);
      most = std::max(most, ratio);
    }
  EXPECT_NEAR(sum / weights, 1, 0.01);
  EXPECT_GT(least, 0.86);
  EXPECT_LT(most, 1.08);
}

TEST(Exchange, MovesTowardsTheAirAndNotPastIt) {
  EXPECT_LE(exposed_exchange(43690, 3), 65535);
  for (const std::int32_t air : {0, 1, 32768, 65534, 65535})
    for (std::int32_t h = 0; h <= 65535; ++h)
      for (const int axes : {1, 3})
        for (const std::int32_t r : {0, 65535}) {
          const std::int32_t after = h + exchanged(h, h, air, 43690, axes, r);
          ASSERT_GE(after, std::min(h, air));
          ASSERT_LE(after, std::max(h, air));
        }
}

TEST(Exchange, WithLatentHeatMovesByNoMoreThanTheTemperaturesDiffer) {
  const Material m{30000, 20000};
  for (const std::int32_t air : {0, 29999, 30000, 30001, 45535, 65535})
    for (std::int32_t h = 0; h <= 65535; ++h)
      for (const std::int32_t r : {0, 65535}) {
        const std::int32_t own = temperature_of(h, m), difference = air - own;
        const std::int32_t g = exchanged(h, own, air, 43690, 3, r);
        ASSERT_LE(std::abs(g), std::abs(difference)) << h << ' ' << air;
        ASSERT_TRUE(h + g >= 0 && h + g <= 65535);
      }
}

TEST(Radiation, NeverCoolsAndNeverOverflows) {
  for (std::int32_t i = 0; i <= 65535; ++i)
    for (const std::int32_t r : {0, 65535}) {
      for (const std::int32_t h : {0, 1, 61439, 61440, 65534, 65535}) {
        const std::int32_t g = radiated(h, i, r);
        ASSERT_TRUE(g >= 0 && h + g <= 65535);
      }
      ASSERT_TRUE(radiated(0, i, r) == i / 16 || radiated(0, i, r) == i / 16 + 1);
    }
  EXPECT_EQ(radiated(0, 0, 65535), 0);
}

TEST(Mixing, IsAMean) {
  std::mt19937_64 random(7);
  const std::array<std::int32_t, 5> heats{0, 1, 32768, 65534, 65535};
  for (int trial = 0; trial < 200000; ++trial) {
    std::uint64_t amount = 0, content = 0;
    std::int32_t low = 65535, high = 0;
    const std::uint64_t parts = 1 + random() % 9;
    for (std::uint64_t part = 0; part < parts; ++part) {
      const std::uint64_t a = random() % 3 == 0 ? 1 : 1 + random() % (65535 / parts);
      const std::int32_t h =
          random() % 2 == 0 ? heats[random() % 5] : static_cast<std::int32_t>(random() % 65536);
      amount += a;
      content += a * static_cast<std::uint64_t>(h);
      low = std::min(low, h);
      high = std::max(high, h);
    }
    for (const std::int32_t r : {0, 1, 65535, static_cast<std::int32_t>(random() % 65536)}) {
      const std::int32_t h = mixed(content, amount, r);
      ASSERT_TRUE(low <= h && h <= high);
      ASSERT_LT(std::abs(static_cast<std::int64_t>(amount) * h - static_cast<std::int64_t>(content)),
                static_cast<std::int64_t>(amount));  // one mixing rounds less than one unit of heat
    }
  }
}

}  // namespace
}  // namespace voxmelt::rule
