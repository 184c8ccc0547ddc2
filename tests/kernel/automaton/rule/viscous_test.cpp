// The viscous law's column and flow.
#include "kernel/automaton/rule/viscous.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>

namespace voxmelt::rule {
namespace {

TEST(Settled, KeepsTheSumAndTheBounds) {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 20000; ++trial) {
    const auto n = static_cast<std::int32_t>(1 + random() % 64);
    std::int64_t mass = static_cast<std::int64_t>(random() % (std::uint64_t(n) * kAmountMax + 1));
    if (trial % 5 == 0) mass = std::int64_t{n} * kAmountMax - static_cast<std::int64_t>(random() % 3);
    if (trial % 5 == 1) mass = std::int64_t{n} * kOne + static_cast<std::int64_t>(random() % 3) - 1;
    std::int64_t sum = 0;
    std::int32_t below = kOne;
    for (std::int32_t k = 0; k < n; ++k) {
      const std::int32_t a = settled(mass, n, k);
      ASSERT_TRUE(a >= 0 && a <= kAmountMax);
      if (mass <= std::int64_t{n} * kOne) {
        ASSERT_LE(a, below) << "full from the bottom";
        ASSERT_TRUE(a == 0 || below == kOne);
        below = a;
      } else {
        ASSERT_GE(a, kOne);
      }
      sum += a;
    }
    ASSERT_EQ(sum, mass) << n << " cells";
  }
}

TEST(Run, Continues) {
  EXPECT_TRUE(run_continues(kOne + 1, 1, kOne + 1, 0));  // over-full: into air too
  EXPECT_FALSE(run_continues(kOne, 1, kOne, 0));
  EXPECT_TRUE(run_continues(kOne / 2, 1, kOne / 2, 1));              // half full, more above
  EXPECT_FALSE(run_continues(kOne / 2 - 1, 1, kOne / 2 - 1, kOne));  // falling liquid above a film
}

Flow flow_of(std::uint32_t mobility, std::uint32_t yield = 0, std::uint8_t stiffness = 8) {
  Flow flow;
  flow.law = Law::viscous;
  flow.viscous = {mobility, yield, stiffness};
  return flow;
}

TEST(RunColumn, HeadIsTheFreeSurface) {
  const Flow flow = flow_of(1 << 20);
  EXPECT_EQ(run_column(3 * kOne, 3, bed_head(5, kBedHalf), 0, flow).head, 8 * 256);
  EXPECT_EQ(run_column(15, 1, 0, 0, flow).head, 0);
  EXPECT_EQ(run_column(16, 1, 0, 0, flow).head, 1);
  EXPECT_EQ(bed_head(2, kBedHalf + 2048), 2 * 256 + 128);
  EXPECT_EQ(bed_head(2, 0), 2 * 256 - 128);
  // Over-full by one cell under a ceiling: eight times as high.
  EXPECT_EQ(run_column(4 * kOne, 3, 0, 0, flow).head, 4 * 256 + 7 * 256);
  EXPECT_EQ(run_column(4 * kOne, 3, 0, 0, flow_of(1, 0, 1)).head, 4 * 256);
}

TEST(RunColumn, MobilityIsQuadraticAndLimited) {
  const Flow gentle = flow_of(4660);  // kappa 0.02
  EXPECT_EQ(run_column(kOne, 1, 0, 0, gentle).mobility, (4660 * 65536LL + (1 << 19)) >> 20);
  EXPECT_EQ(run_column(2 * kOne, 2, 0, 0, gentle).mobility, (4660 * 4 * 65536LL + (1 << 19)) >> 20);
  const Flow runny = flow_of((1 << 24) - 1);
  for (std::int32_t n = 1; n <= 1024; ++n)
    for (const std::int64_t mass :
         {std::int64_t{n} * kOne, std::int64_t{n} * kOne + 1, std::int64_t{n} * kAmountMax}) {
      const Column c = run_column(mass, n, 0, 65535, runny);
      ASSERT_TRUE(c.mobility >= 0 && c.mobility <= 8192 / (mass / kOne + 1));
      ASSERT_TRUE(c.exposed >= c.mobility && c.exposed <= 8192) << "a bare flank: limited per cell";
      ASSERT_GE(c.dead, 1);
      ASSERT_TRUE(c.in_run);
    }
  // Thermal viscosity: half at 16384.
  Flow warm = gentle;
  warm.thermal_viscosity = true;
  warm.mobility_table.fill(16384);
  EXPECT_EQ(run_column(2 * kOne, 2, 0, 0, warm).mobility, run_column(2 * kOne, 2, 0, 0, gentle).mobility / 2);
}

TEST(RunColumn, YieldMakesADeadZone) {
  const Flow flow = flow_of(4660, 655);                        // 0.01
  EXPECT_EQ(run_column(kOne, 1, 0, 0, flow).dead, 3);          // 655 / 256 = 2.56
  EXPECT_EQ(run_column(kOne / 4, 1, 0, 0, flow).dead, 10);     // 655 / 64 = 10.2
  EXPECT_EQ(run_column(100 * kOne, 100, 0, 0, flow).dead, 1);  // at least one unit
  EXPECT_EQ(run_column(1, 1, 0, 0, flow).dead, 655);
}

Column run_at(std::int32_t head, std::int32_t mobility, std::int32_t dead = 1) {
  return {head, mobility, mobility, dead, true};
}

TEST(ViscousFlow, StaysWithinGiverAndTaker) {
  for (const std::int32_t mobility : {0, 1, 4096, 8192})
    for (const std::int32_t a : {1, 7, 8, 4096, 65535})
      for (const std::int32_t b : {0, 1, 4088, 4089, 4096, 4097, 65527, 65528, 65535})
        for (const std::int32_t drop : {0, 1, 2, 256, 362, 363, 1 << 24})
          for (const bool diagonal : {false, true})
            for (const std::int32_t r : {0, 65535})
              for (const bool in_run : {false, true}) {
                Column taker = run_at(1000, mobility, 0);
                taker.in_run = in_run;
                const std::int32_t f = viscous_flow(run_at(1000 + drop, mobility), a, taker, b, diagonal, r);
                const std::int32_t room = (in_run ? kAmountMax : kOne) - b;
                ASSERT_TRUE(f >= 0 && 8 * f <= a && 8 * f <= std::max(0, room));
                if (drop <= 1) {
                  ASSERT_EQ(f, 0);
                }
                ASSERT_EQ(viscous_flow(taker, b, run_at(1000 + drop, mobility), a, diagonal, r), 0)
                    << "one giver";
              }
}

TEST(ViscousFlow, GrowsWithDropAmountAndMobility) {
  for (const bool diagonal : {false, true})
    for (const std::int32_t r : {0, 12345, 65535}) {
      std::int32_t last = 0;
      for (std::int32_t drop = 0; drop < 400; ++drop) {
        const std::int32_t f = viscous_flow(run_at(drop, 3000), 4096, run_at(0, 3000), 4000, diagonal, r);
        ASSERT_GE(f, last);
        last = f;
      }
      EXPECT_GT(last, 0);
      last = 0;
      for (std::int32_t m = 0; m <= 8192; m += 64) {
        const std::int32_t f = viscous_flow(run_at(256, m), 4096, run_at(0, m), 0, diagonal, r);
        ASSERT_GE(f, last);
        last = f;
      }
    }
}

// An axis flow of one cell of drop is the mean mobility times the amount; a diagonal one a quarter of it.
TEST(ViscousFlow, Value) {
  EXPECT_EQ(viscous_flow(run_at(256, 4096), 4096, run_at(0, 4096), 4096, false, 0),
            256);  // 4096 x 4096 / 65536
  EXPECT_EQ(viscous_flow(run_at(256, 4096), 4096, run_at(0, 4096), 4096, true, 0), 64);
  EXPECT_EQ(viscous_flow(run_at(256, 4096), 4096, bed_column(0), 0, false, 0),
            128);  // a dry bed has no mobility
}

TEST(ViscousFlow, DeadZoneOfADiagonalIsElevenEighths) {
  const Column giver = run_at(0, 8192, 16);
  EXPECT_EQ(viscous_flow(giver, 4096, run_at(-16, 8192), 0, false, 65535), 0);
  EXPECT_GT(viscous_flow(giver, 4096, run_at(-17, 8192), 0, false, 65535), 0);
  EXPECT_EQ(viscous_flow(giver, 4096, run_at(-22, 8192), 0, true, 65535), 0);
  EXPECT_GT(viscous_flow(giver, 4096, run_at(-23, 8192), 0, true, 65535), 0);
}

TEST(ViscousFlow, OnlyRunsGive) {
  EXPECT_EQ(viscous_flow(bed_column(1000), 4096, run_at(0, 8192), 0, false, 65535), 0);
  EXPECT_EQ(viscous_flow(top_column(run_at(1000, 8192)), 4096, run_at(0, 8192), 0, false, 65535), 0);
  EXPECT_EQ(top_column(run_at(700, 77)).head, 700);
  EXPECT_EQ(top_column(run_at(700, 77)).mobility, 77);
  EXPECT_EQ(air_column(3).head, 256);
}

}  // namespace
}  // namespace voxmelt::rule
