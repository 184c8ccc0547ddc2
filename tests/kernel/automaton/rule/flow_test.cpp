// The bounds of the vertical rules and of the paper's spreading hold at 0, 1, the maximum and in between.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>

#include "kernel/automaton/rule/gravity.h"
#include "kernel/automaton/rule/source.h"
#include "kernel/automaton/rule/spread.h"

namespace voxmelt::rule {
namespace {

constexpr std::array<std::int32_t, 15> kAmounts{0,    1,    2,     31,    32,    33,    2048, 4095,
                                                4096, 4097, 32768, 45055, 45056, 65534, 65535};

TEST(Released, IsPartOfTheAmountAndMovesDustWhole) {
  for (const std::uint32_t factor : {0u, 1u, 8192u, 32768u, 65535u, 65536u})
    for (const std::int32_t minimum : {0, 1, 32, 4096, 65535})
      for (std::int32_t a = 0; a <= kAmountMax; ++a) {
        const std::int32_t r = released(a, factor, minimum);
        ASSERT_TRUE(r >= 0 && r <= a);
        if (a <= minimum || factor == 65536) {
          ASSERT_EQ(r, a);
        }
      }
}

TEST(Released, HangsBelowAnOverhangUntilHeavy) {
  Fall fall;
  fall.wall_factor = 8192;
  fall.hang = 1024;
  EXPECT_EQ(released(1023, fall, {false, true}), 0);
  EXPECT_EQ(released(1024, fall, {false, true}), 1024);
  EXPECT_EQ(released(1023, fall, {false, false}), 1023);
  EXPECT_EQ(released(4096, fall, {true, false}), 512 + 32);
  EXPECT_EQ(released(20, fall, {true, false}), 20);
  fall.hang = 0;
  EXPECT_EQ(released(4096, fall, {false, false, true}), 0) << "it is set, and clings";
  EXPECT_EQ(released(1, fall, {true, true}), 1);
}

TEST(Fallen, FillsToOneAndNoMore) {
  for (const std::int32_t lower : kAmounts)
    for (const std::int32_t ready : kAmounts) {
      const std::int32_t f = fallen(lower, ready);
      EXPECT_TRUE(f >= 0 && f <= ready);
      EXPECT_LE(lower + f, std::max(lower, kOne));
      if (lower + ready >= kOne) {
        EXPECT_GE(lower + f, kOne) << "no room left unused";
      }
    }
}

TEST(PushedUp, FitsAboveAndLeavesOne) {
  for (const std::int32_t lower : kAmounts)
    for (const std::int32_t upper : kAmounts) {
      const std::int32_t f = pushed_up(lower, upper);
      EXPECT_TRUE(f >= 0 && upper + f <= kAmountMax);
      EXPECT_GE(lower - f, std::min(lower, kOne));
    }
}

TEST(EnergyFallen, StaysWithinTheAmounts) {
  PaperLaw law;
  for (const EnergyReading reading : {EnergyReading::text, EnergyReading::printed})
    for (const std::uint32_t beta : {0u, 1u, 65535u, 65536u, 131072u, 262144u}) {
      law.reading = reading;
      law.beta = beta;
      for (const std::int32_t a : kAmounts)
        for (const std::int32_t e : kAmounts)
          for (const std::int32_t below : kAmounts)
            for (const std::int32_t e_below : kAmounts) {
              if (e > a || e_below > below) continue;
              const std::int32_t f = fallen(below, a);
              const EnergyMove m = energy_fallen(e, f, below + f - e_below, law);
              ASSERT_TRUE(m.lost >= 0 && m.lost <= e && m.gained >= 0);
              ASSERT_LE(e_below + m.gained, below + f);
              if (reading == EnergyReading::printed || beta == 65536) {
                ASSERT_EQ(m.lost, m.gained);
              }
              if (reading == EnergyReading::text && beta < 65536) {
                ASSERT_LE(m.gained, m.lost);
              }
            }
    }
}

TEST(Shared, GiverHasWhatItGives) {
  for (std::int32_t a = 0; a <= kAmountMax; ++a) {
    const std::int32_t f8 = shared(a, 13107, flow_cap(8), false), d8 = shared(a, 13107, flow_cap(8), true);
    ASSERT_LE(4 * f8 + 4 * d8, a);
    ASSERT_LE(f8, kOne);
    ASSERT_LE(d8, kOne / 4);
    const std::int32_t f4 = shared(a, 16384, flow_cap(4), false);
    ASSERT_LE(4 * f4, a);
    ASSERT_LE(f4, 2 * kOne);
  }
}

TEST(Shared, TableRowsGiveAtMostTheAmount) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    std::array<std::int32_t, 4> row{};  // sums to 65536
    std::int32_t left = 65536;
    for (std::size_t d = 0; d < 3; ++d)
      left -= row[d] = static_cast<std::int32_t>(random() % static_cast<unsigned>(std::min(left, 65535) + 1));
    row[3] = std::min(left, 65535);
    for (const std::int32_t a : kAmounts) {
      std::int32_t sum = 0;
      for (const std::int32_t share : row) sum += shared(a, share, flow_cap(4), false);
      ASSERT_LE(sum, a);
    }
  }
}

TEST(Receives, TheLargestInflowFits) {
  EXPECT_EQ(receiver_limit(8) - 1 + 4 * flow_cap(8) + 4 * (flow_cap(8) >> 2), kAmountMax);
  EXPECT_EQ(receiver_limit(4) - 1 + 4 * flow_cap(4), kAmountMax);
  PaperLaw law;
  for (const int neighbours : {4, 8})
    for (const bool downhill : {false, true}) {
      law.neighbours = neighbours;
      law.downhill = downhill;
      for (std::int32_t b = receiver_limit(neighbours); b <= kAmountMax; ++b)
        ASSERT_FALSE(receives(65535, 0, b, 0, false, law));
      EXPECT_EQ(receives(100, 0, receiver_limit(neighbours) - 1, 0, false, law), !downhill);
    }
}

// With downhill, a face has at most one giver, and the giver does not end below the taker by that flow alone.
TEST(Receives, DownhillHasOneGiver) {
  PaperLaw law;
  for (const std::int32_t a : kAmounts)
    for (const std::int32_t b : kAmounts)
      for (const std::int32_t margin : {0, 256, 65535})
        for (const bool diagonal : {false, true}) {
          const std::int32_t fa = shared(a, 13107, kOne, false), fb = shared(b, 13107, kOne, false);
          const bool down = receives(a, fa, b, margin, diagonal, law);
          EXPECT_FALSE(down && receives(b, fb, a, margin, diagonal, law));
          if (down) {
            EXPECT_GT(a, b + std::max(fa, margin));
          }
        }
}

TEST(Margin, EnergeticStarvedAndResting) {
  PaperLaw law;
  law.threshold = 1000;
  law.margin = 256;
  EXPECT_EQ(spread_margin(1001, law), 256);
  EXPECT_EQ(spread_margin(1000, law), -1);
  law.slump = 1024;
  EXPECT_EQ(spread_margin(1000, law), 1024);
}

TEST(Alpha, FloorBeforeSolidBeforeLiquid) {
  PaperLaw law;
  law.alpha_liquid = 1;
  law.alpha_solid = 2;
  law.alpha_floor = 3;
  EXPECT_EQ(contact_alpha(false, false, law), 1);
  EXPECT_EQ(contact_alpha(true, false, law), 2);
  EXPECT_EQ(contact_alpha(true, true, law), 3);
}

TEST(ThermalShare, StaysUnderTheGiversBound) {
  Flow flow;
  flow.thermal_viscosity = true;
  for (const int neighbours : {4, 8})
    for (const std::int32_t entry : {0, 1, 16384, 32768, 65535})
      for (const std::int32_t share : {0, 1, 8192, 13107}) {
        flow.paper.neighbours = neighbours;
        flow.mobility_table.fill(static_cast<std::uint16_t>(entry));
        const std::int32_t warm = thermal_share(share, 65535, flow);
        EXPECT_TRUE(warm >= 0 && warm <= (neighbours == 8 ? 13107 : 16384));
        if (entry == 32768) {
          EXPECT_EQ(warm, share);
        }
      }
}

TEST(Source, VentsAndDrainsStayWithinTheCell) {
  for (const std::int32_t a : kAmounts)
    for (const std::int32_t rate : kAmounts) {
      EXPECT_TRUE(vented(a, rate) >= 0 && a + vented(a, rate) <= kAmountMax);
      EXPECT_TRUE(drained(a, rate) >= 0 && drained(a, rate) <= a);
      EXPECT_LE(vented_energy(rate, 4096), rate);
    }
  EXPECT_TRUE(is_open(5, 7, 5) && is_open(5, 7, 6));
  EXPECT_FALSE(is_open(5, 7, 4) || is_open(5, 7, 7));
  const Region region{{8, 8, 8}, 16};  // centre of cell 0, one cell wide
  EXPECT_TRUE(contains(region, 0, 0, 0) && contains(region, 1, 0, 0));
  EXPECT_FALSE(contains(region, 1, 1, 0) || contains(region, 2, 0, 0));
}

}  // namespace
}  // namespace voxmelt::rule
