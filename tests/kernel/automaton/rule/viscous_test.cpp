// The viscous law's column and flow are tested.
#include "kernel/automaton/rule/viscous.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "kernel/automaton/rule/solid_bed.h"

namespace voxmelt::rule {
namespace {

TEST(Shut, FullUnderACeilingButForASixtyFourth) {
  for (const std::int64_t excess : {-64, 0, 64}) {
    EXPECT_TRUE(is_shut(5 * kOne + excess, 5, true));
    EXPECT_FALSE(is_shut(5 * kOne + excess, 5, false));
  }
  for (const std::int64_t excess : {-4096, -65, 65, 4096}) EXPECT_FALSE(is_shut(5 * kOne + excess, 5, true));
}

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
  EXPECT_TRUE(run_continues(kOne + 1, 1, kOne + 1, 0));  // over-full: it continues into air, too
  EXPECT_FALSE(run_continues(kOne, 1, kOne, 0));
  EXPECT_TRUE(run_continues(kOne / 2, 1, kOne / 2, 1));              // half full, with more above
  EXPECT_FALSE(run_continues(kOne / 2 - 1, 1, kOne / 2 - 1, kOne));  // falling liquid above a film
}

Flow flow_of(std::uint64_t mobility, std::uint32_t yield = 0, std::uint8_t stiffness = 8) {
  Flow flow;
  flow.law = Law::viscous;
  flow.viscous = {mobility, yield, stiffness};
  return flow;
}

TEST(RunColumn, HeadIsTheFreeSurface) {
  const Flow flow = flow_of(std::uint64_t{1} << 32);
  EXPECT_EQ(run_column(3 * kOne, 3, bed_head(5, kBedHalf), 0, flow).head, 8 * 512);
  EXPECT_EQ(run_column(7, 1, 0, 0, flow).head, 0);
  EXPECT_EQ(run_column(8, 1, 0, 0, flow).head, 1);
  EXPECT_EQ(bed_head(2, kBedHalf + 2048), 2 * 512 + 256);
  EXPECT_EQ(bed_head(2, 0), 2 * 512 - 256);
  EXPECT_EQ(bed_head(2, -2048), 512);
  // Under a ceiling, the one cell that is too much counts eight times in the head.
  EXPECT_EQ(run_column(4 * kOne, 3, 0, 0, flow).head, 4 * 512 + 7 * 512);
  EXPECT_EQ(run_column(4 * kOne, 3, 0, 0, flow_of(1, 0, 1)).head, 4 * 512);
}

TEST(RunColumn, MobilityIsQuadraticAndLimited) {
  const Flow gentle = flow_of(19088744);  // kappa 0.02
  // 2/9 x 0.02 of 2^24 is 74565.4. At depth 2 it is four times that, and at depth 1/64 it is 4096 times less.
  EXPECT_EQ(run_column(kOne, 1, 0, 0, gentle).mobility, 74565);
  EXPECT_EQ(run_column(2 * kOne, 2, 0, 0, gentle).mobility, 298262);
  EXPECT_EQ(run_column(kOne / 64, 1, 0, 0, gentle).mobility, 18);
  EXPECT_EQ(run_column(15, 1, 0, 0, gentle).mobility, 0);
  EXPECT_EQ(run_column(100 * kOne, 100, 0, 0, gentle).exposed, 1 << 21);
  const Flow runny = flow_of((std::uint64_t{1} << 36) - 1);
  for (std::int32_t n = 1; n <= 1024; ++n)
    for (const std::int64_t mass :
         {std::int64_t{n} * kOne, std::int64_t{n} * kOne + 1, std::int64_t{n} * kAmountMax}) {
      const Column c = run_column(mass, n, 0, 65535, runny);
      ASSERT_TRUE(c.limit >= 1 && (c.limit == 1 || c.limit <= 13107 / (mass / kOne + 1)));
      ASSERT_EQ(c.mobility, c.limit << 8);
      ASSERT_TRUE(c.limited);
      ASSERT_EQ(c.exposed, 1 << 21) << "a bare flank: limited per cell";
      ASSERT_GE(c.dead, 1);
      ASSERT_TRUE(c.in_run);
    }
}

// The mobility doubles in an eighth of the range (65536 x 64 / 512 = 8192). By hand from docs/automaton.md,
// half an octave has f = 32768, 22479 f >> 16 = 11239, f x 54296 >> 20 = 1696: 5792 / 4096 = 1.41406.
TEST(Viscous, MobilityDoublesWithHeat) {
  Flow warm = flow_of(1);
  warm.thermal_viscosity = true;
  warm.mobility_reference = 20000;
  warm.mobility_rate = 512;
  const auto at = [&](std::int32_t h) { return warmed(1 << 20, h, warm); };
  EXPECT_EQ(at(20000), 1 << 20);
  EXPECT_EQ(at(20000 + 8192), 1 << 21);
  EXPECT_EQ(at(20000 - 8192), 1 << 19);
  EXPECT_EQ(at(20000 + 4096), 1482752);  // 2^20 x 5792 / 4096
  EXPECT_EQ(at(20000 - 4096), 741376);
  for (std::int32_t h = 0; h < 65536; ++h)
    ASSERT_NEAR(static_cast<double>(at(h)) / std::exp2(20 + (h - 20000) / 8192.0), 1, 0.004) << h;
  // Eight octaves above the reference and 32 below it, the law ends.
  warm.mobility_rate = 32767;
  EXPECT_EQ(at(65535), (std::int64_t{8191} << 20) >> 5);
  EXPECT_EQ(at(0), 0);
  EXPECT_EQ(warmed((std::int64_t{1} << 40) - 1, 0, warm), 255);
}

// The limit is a fifth of a cell, and less by depth. An overfull run is stiffer.
TEST(RunColumn, Limit) {
  const Flow flow = flow_of(19088744);
  EXPECT_EQ(run_column(kOne - 1, 1, 0, 0, flow).limit, 13107);
  EXPECT_EQ(run_column(kOne, 1, 0, 0, flow).limit, 6553);
  EXPECT_EQ(run_column(9 * kOne, 9, 0, 0, flow).limit, 1310);
  EXPECT_EQ(run_column(9 * kOne, 8, 0, 0, flow).limit, 163);  // 1310 / 8
  EXPECT_EQ(run_column(std::int64_t{65535} * 4096, 4096, 0, 0, flow).limit, 1);
  EXPECT_FALSE(run_column(kOne, 1, 0, 0, flow).limited);
  EXPECT_TRUE(run_column(9 * kOne, 9, 0, 0, flow).limited);  // 6039797 > 1310 x 256
}

// Sub-steps divide the mobility, and 19 of them leave nothing to the limit of depth 9: 6039797 / 335360.
TEST(RunColumn, SubstepsDivideTheMobility) {
  const Flow flow = flow_of(19088744);
  EXPECT_EQ(run_column(kOne, 1, 0, 0, flow, 4).mobility, 18641);
  EXPECT_EQ(run_column(kOne, 1, 0, 0, flow, 1024).mobility, 73);
  EXPECT_EQ(needed_substeps(9 * kOne, 9, 0, flow), 19);
  EXPECT_TRUE(run_column(9 * kOne, 9, 0, 0, flow, 18).limited);
  EXPECT_FALSE(run_column(9 * kOne, 9, 0, 0, flow, 19).limited);
  EXPECT_EQ(needed_substeps(kOne / 2, 1, 0, flow), 1);
  EXPECT_EQ(needed_substeps(1, 1, 0, flow), 0);
}

// n sub-steps at a steady flux round as one step: sum of floor(x + R_k) = floor(n x + D), in 1/65536.
TEST(PairDither, SubstepsRoundAsOneStep) {
  for (const int n : {1, 2, 3, 7, 16, 1000, 1024})
    for (const std::uint32_t step : {0u, 1u, 2u, 77u, 65535u})
      for (int axis = 0; axis < 4; ++axis)
        for (const std::int64_t x : {0, 1, 40, 65, 20000, 65535, 100000}) {
          std::int64_t sum = 0;
          for (int k = 0; k < n; ++k) sum += (x + pair_dither(step, axis, 0, k, n)) >> 16;
          ASSERT_EQ(sum, (n * x + dither(step, axis, 4)) >> 16) << n << " sub-steps";
        }
  // By hand, n = 2 and D = 0 give 0 and 1/2. Axis 2 begins with its second one.
  EXPECT_EQ(pair_dither(0, 0, 0, 0, 2), 0);
  EXPECT_EQ(pair_dither(0, 0, 0, 1, 2), 32768);
  EXPECT_EQ(pair_dither(0, 2, 0, 0, 2), 49152);  // (1/2 + 1) / 2
  EXPECT_EQ(pair_dither(0, 2, 0, 1, 2), 16384);
}

// The bits come in reverse order: heights 0 to 3 are at 0, 1/2, 1/4 and 3/4. Axis 1 is a quarter ahead.
TEST(PairDither, LayersRoundInTurn) {
  for (const auto& [y, axis0, axis1] :
       {std::array{0, 0, 16384}, {1, 32768, 49152}, {2, 16384, 32768}, {3, 49152, 0}}) {
    EXPECT_EQ(pair_dither(0, 0, y, 0, 1), axis0);
    EXPECT_EQ(pair_dither(0, 1, y, 0, 1), axis1);
  }
  // If 16 layers each give x, 16 x flows at every step, to a unit.
  for (std::uint32_t step = 0; step < 64; ++step)
    for (const std::int32_t x : {0, 4096, 20480, 61440, 69632}) {
      std::int32_t sum = 0;
      for (int y = 0; y < 16; ++y) sum += (x + pair_dither(step, 0, y, 0, 1)) >> 16;
      ASSERT_EQ(sum, x / 4096) << step;
    }
}

TEST(MixingDither, IsTheStepsInItsFirstSubstep) {
  EXPECT_EQ(mixing_dither(5, 0), dither(5));
  EXPECT_EQ(mixing_dither(1, 1), 0);  // 1/2 + 1/2
  EXPECT_EQ(mixing_dither(0, 3), 49152);
}

TEST(RunColumn, YieldMakesADeadZone) {
  const Flow flow = flow_of(19088744, 655);                    // a yield of 0.01
  EXPECT_EQ(run_column(kOne, 1, 0, 0, flow).dead, 5);          // 1310 / 256 = 5.12
  EXPECT_EQ(run_column(kOne / 4, 1, 0, 0, flow).dead, 20);     // 1310 / 64 = 20.5
  EXPECT_EQ(run_column(100 * kOne, 100, 0, 0, flow).dead, 1);  // at least one unit
  EXPECT_EQ(run_column(1, 1, 0, 0, flow).dead, 1310);
}

// Makes a column in a run. The mobility is in 1/65536.
Column run_at(std::int32_t head, std::int32_t mobility, std::int32_t dead = 1) {
  return {head, mobility << 8, mobility << 8, dead, true, kNoBed, 13107};
}

TEST(ViscousFlow, StaysWithinGiverAndTaker) {
  for (const std::int32_t mobility : {0, 1, 4096, 8192})
    for (const std::int32_t a : {1, 7, 8, 4096, 65535})
      for (const std::int32_t b : {0, 1, 4088, 4089, 4096, 4097, 65527, 65528, 65535})
        for (const std::int32_t drop : {0, 1, 2, 512, 724, 725, 1 << 24})
          for (const bool diagonal : {false, true})
            for (const std::int32_t r : {0, 65535})
              for (const bool in_run : {false, true}) {
                Column taker = run_at(1000, mobility, 0);
                taker.in_run = in_run;
                const std::int32_t f = viscous_flow(run_at(1000 + drop, mobility), a, taker, b, diagonal, r);
                const std::int32_t room = (in_run ? kAmountMax : kOne) - b;
                const std::int32_t times = diagonal ? 20 : 5;  // 4/5 + 4/20 = 1
                ASSERT_TRUE(f >= 0 && times * f <= a && times * f <= std::max(0, room));
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
      for (std::int32_t drop = 0; drop < 800; ++drop) {
        const std::int32_t f = viscous_flow(run_at(drop, 3000), 4096, run_at(0, 3000), 4000, diagonal, r);
        ASSERT_GE(f, last);
        last = f;
      }
      EXPECT_GT(last, 0);
      last = 0;
      for (std::int32_t m = 0; m <= 8192; m += 64) {
        const std::int32_t f = viscous_flow(run_at(kHeadOne, m), 4096, run_at(0, m), 0, diagonal, r);
        ASSERT_GE(f, last);
        last = f;
      }
    }
}

// An axis flow at one cell of drop is the mean mobility times the amount. A diagonal one is a quarter of it.
TEST(ViscousFlow, Value) {
  EXPECT_EQ(viscous_flow(run_at(kHeadOne, 4096), 4096, run_at(0, 4096), 4096, false, 0),
            256);  // 4096 x 4096 / 65536
  EXPECT_EQ(viscous_flow(run_at(kHeadOne, 4096), 4096, run_at(0, 4096), 4096, true, 0), 64);
  EXPECT_EQ(viscous_flow(run_at(kHeadOne, 4096), 4096, bed_column(0), 0, false, 0),
            128);  // a dry bed has no mobility
}

// Axes get 1 / (1 + 2 s^2): 2/3 at 1/2, 1/3 at 1. Diagonals get 1 / (1 + s^2 + s^4)^2: (16/21)^2 and 1/9.
// Beside a run, or above one, the flow is at most twice the giver's limit: 200/65536 of 4096 over two. A bare
// flank has its own bound.
TEST(ViscousFlow, ADeepGiverHoldsBack) {
  Column giver = run_at(kHeadOne, 100);
  giver.limit = 100;
  giver.exposed = 1000 << 8;
  EXPECT_EQ(viscous_flow(giver, 4096, run_at(0, 3000), 4096, false, 0), 6);                   // 6.25
  EXPECT_EQ(viscous_flow(giver, 4096, run_at(0, 50), 4096, false, 0), 4);                     // 150: 4.69
  EXPECT_EQ(viscous_flow(giver, 4096, top_column(run_at(0, 3000)), 0, false, 0), 6);          // 6.25
  EXPECT_EQ(viscous_flow(giver, 4096, bed_column(0), 0, false, 0), 31);                       // 1000: 31.25
  EXPECT_EQ(viscous_flow(run_at(kHeadOne, 3000), 4096, run_at(0, 100), 4096, false, 0), 96);  // 3100: 96.9
}

TEST(BedRise, Value) {
  EXPECT_EQ(bed_rise(40, 40), 0);
  EXPECT_EQ(bed_rise(40, 43), 3);
  EXPECT_EQ(bed_rise(43, 40), 3);
  EXPECT_EQ(bed_rise(4000, 40), 31) << "a cliff is nearly as steep as 2";
  EXPECT_EQ(bed_rise(40, kNoBed), 0) << "air has no bed";
  EXPECT_EQ(bed_rise(kNoBed, 40), 0);
}

TEST(SlopeFactor, Value) {
  for (const bool diagonal : {false, true}) EXPECT_EQ(slope_factor(0, 0, diagonal, 0), 16384);
  EXPECT_EQ(slope_factor(8, 0, false, 0), 10485);  // (2^22 / 320)^2 / 2^14: 13107^2 / 16384 = 10485.4
  EXPECT_EQ(slope_factor(0, 8, false, 0), 10485);
  EXPECT_EQ(slope_factor(16, 0, false, 0), 4096);  // a slope of 1: 1/4
  EXPECT_EQ(slope_factor(16, 0, true, 0), 7280);   // 128 / 256: 10922^2 / 16384 = 7280.9
  EXPECT_EQ(slope_factor(16, 16, true, 0), 4096);
  EXPECT_EQ(slope_factor(32, 32, false, 0), 1824);  // 511: 5468^2 / 16384 = 1824.9
  EXPECT_EQ(slope_factor(32, 32, true, 0), 1824);
  for (std::int32_t along = 0; along <= 16; ++along)
    for (std::int32_t across = 0; across < 16; ++across) {
      const double square = along * along + across * across;
      EXPECT_NEAR(slope_factor(along, across, false, 0), 16384 / std::pow(1 + square / 256, 2), 3);
      EXPECT_NEAR(slope_factor(along, across, true, 0), 16384 / std::pow(1 + std::floor(square / 2) / 256, 2),
                  3);
    }
}

// A blocked cell beside an axis pair adds an eighth of its factor. All four of them make a channel
// of one cell, which carries what the axis and two diagonals carry in a sheet: 2/3 + 2/3 x 4/8 = 1.
TEST(SlopeFactor, AnAxisHasTheShareOfBlockedDiagonals) {
  for (int blocked = 0; blocked <= 4; ++blocked) {
    EXPECT_EQ(slope_factor(0, 0, false, blocked), 16384 + 2048 * blocked);
    EXPECT_EQ(slope_factor(16, 0, false, blocked), 4096 + 512 * blocked);
  }
}

// On a plane of any slope, a film's axes carry 2/3 and its diagonals 1/3, and the sum goes straight down.
TEST(SlopeFactor, AFilmCarriesNusseltsFluxInEveryDirection) {
  const auto sixteenths = [](double between) {
    return static_cast<std::int32_t>(std::lround(16 * std::abs(between)));
  };
  const auto factor = [&](double along, double across, bool diagonal) {
    return slope_factor(sixteenths(along), sixteenths(across), diagonal, 0) / 16384.0;
  };
  for (const std::array<double, 2> slope : {std::array{0.25, 0.0},
                                            {0.5, 0.0},
                                            {0.25, 0.25},
                                            {0.4375, 0.1875},
                                            {1.0, 0.0},
                                            {0.75, 0.75},
                                            {0.9375, 0.4375},
                                            {0.5, 1.25}}) {
    const double x = slope[0], z = slope[1], sum = x + z, difference = x - z;
    const double right = factor(sum, difference, true) * sum / 6;
    const double left = factor(difference, sum, true) * difference / 6;
    const double along_x = factor(x, z, false) * x * 2 / 3 + right + left;
    const double along_z = factor(z, x, false) * z * 2 / 3 + right - left;
    const double square = x * x + z * z, exact = square / std::pow(1 + square, 2);
    EXPECT_NEAR((along_x * x + along_z * z) / exact, 1, 0.01) << x << ", " << z;
    EXPECT_NEAR((along_z * x - along_x * z) / exact, 0, 0.01) << x << ", " << z;
  }
}

Column run_on(std::int32_t bed, Column column) {
  column.bed = bed;
  return column;
}

// 256 (diagonals: 64) flow between level beds. 0.64 of it flow on slope 1/2. A diagonal that falls by 1/2
// lies on a slope of 0.354, where 0.79 flow.
TEST(ViscousFlow, IsLessOnASlope) {
  const auto flow = [](std::int32_t bed, bool diagonal, std::int32_t dither, std::int32_t across = 0) {
    return viscous_flow(run_on(24, run_at(kHeadOne, 4096)), 4096, run_on(bed, run_at(0, 4096)), 4096,
                        diagonal, dither, 0, across);
  };
  EXPECT_EQ(flow(24, false, 0), 256);
  EXPECT_EQ(flow(24, false, 0, 8), 163);
  EXPECT_EQ(flow(16, false, 0), 163);      // 163.81
  EXPECT_EQ(flow(16, false, 24576), 164);  // and the dither adds 3/8
  EXPECT_EQ(flow(16, true, 0), 50);        // 50.56
  EXPECT_EQ(flow(16, true, 57344), 51);    // and the dither adds 7/8
  EXPECT_EQ(flow(8, false, 0), 64);
  EXPECT_EQ(flow(0, false, 0), 28);  // steeper than 1.41: 28.5
}

TEST(ViscousFlow, BetweenLevelBedsIsAPlainProduct) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 20000; ++trial) {
    const auto below = [&](std::uint64_t n) { return static_cast<std::int32_t>(random() % n); };
    const std::int32_t drop = 2 + below(800), mobility = below(8193), a = 1 + below(65535), r = below(65536);
    const std::int64_t c =
        std::min<std::int64_t>((1 << 24) - 1, (std::int64_t{512} * mobility * ((a + 1) / 2)) >> 12);
    const std::int64_t axis = (c * std::min(drop, 512) + (r << 6)) >> 22;
    const std::int64_t diagonal = (c * std::min(drop, 724) + (r << 8)) >> 24, fifth = a * 13107 >> 16;
    const Column giver = run_on(7, run_at(drop, mobility)), taker = run_on(7, run_at(0, mobility));
    ASSERT_EQ(viscous_flow(giver, a, taker, 0, false, r), std::min(axis, fifth));
    ASSERT_EQ(viscous_flow(giver, a, taker, 0, true, r), std::min(diagonal, fifth >> 2));
  }
}

// With mobilities of 1/16, a drop of one cell moves 1/16 of the amount that flows. The cells hold 3000 and
// 1001.
TEST(ViscousFlow, TheMeanOfBothFlowsBetweenLevelBeds) {
  const Column giver = run_on(24, run_at(kHeadOne, 4096)), level = run_on(24, run_at(0, 4096));
  EXPECT_EQ(viscous_flow(giver, 3000, level, 1001, false, 0), 125);  // 2001 / 16 = 125.06
  EXPECT_EQ(viscous_flow(giver, 3000, level, 1001, true, 0), 31);    // a quarter
  EXPECT_EQ(viscous_flow(giver, 3000, level, 1000, false, 0), 125);  // 2000.5 rounds up
  Column low = bed_column(24 * kHeadOne / 16);
  low.head = 0;
  EXPECT_EQ(viscous_flow(giver, 3000, low, 0, false, 0), 46);  // a dry bed: 1500 / 32 = 46.9
  // If the beds differ, or there is none, the giver's amount alone counts.
  EXPECT_EQ(viscous_flow(giver, 3000, run_on(23, level), 1001, false, 0), 186);  // 187.5 x 16257 / 16384
  EXPECT_EQ(viscous_flow(giver, 3000, run_on(kNoBed, level), 1001, false, 0), 187);
  EXPECT_EQ(viscous_flow(run_on(kNoBed, giver), 3000, run_on(kNoBed, level), 1001, false, 0), 187);
}

TEST(Bed, IsShownInSixteenths) {
  const Flow flow = flow_of(19088744);
  EXPECT_EQ(run_column(3 * kOne, 3, bed_head(5, kBedHalf), 0, flow).bed, 80);
  EXPECT_EQ(run_column(3 * kOne, 3, bed_head(5, 4095), 0, flow).bed, 87);  // 80 + 7.99
  EXPECT_EQ(bed_column(bed_head(5, 0)).bed, 72);
  EXPECT_EQ(top_column(run_on(33, run_at(700, 77))).bed, 33);
  EXPECT_EQ(air_column(3).bed, kNoBed);
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
  EXPECT_EQ(top_column(run_at(700, 77)).mobility, 77 << 8);
  EXPECT_EQ(top_column(run_at(700, 77)).limit, 13107);
  EXPECT_EQ(air_column(3).head, 512);
}

// With latent heat 20000 the melting range has k = 1, w = 40000 and scale ceil(2^28 / 40000 = 6710.9) = 6711.
// Without latent heat it is the last 4096 units: k = 3, w = 32768 and scale 8192.
TEST(SolidBed, FollowsFromAmountAndHeat) {
  Parameters p;
  p.heat.enabled = true;
  p.material = {.melting_point = 30000, .latent_heat = 20000};
  const SolidBed bed(p);
  EXPECT_EQ(bed.offset(4096, 0), 2048) << "flat";
  EXPECT_EQ(bed.offset(4096, 30000), 2048) << "40000 x 6711 >> 16 = 4096";
  EXPECT_EQ(bed.offset(4096, 40000), 0) << "half way: 20000 x 6711 >> 16 = 2048";
  EXPECT_EQ(bed.offset(4096, 49999), -2048) << "2 x 6711 >> 16 = 0";
  EXPECT_EQ(bed.offset(4096, 60000), -2048);
  EXPECT_EQ(bed.offset(1024, 0), -1024);
  EXPECT_EQ(bed.offset(1024, 40000), -1536);
  EXPECT_EQ(bed.offset(65535, 0), 4095) << "cut at 6143";

  p.material.latent_heat = 0;
  EXPECT_EQ(SolidBed(p).offset(4096, 25904), 2048);
  EXPECT_EQ(SolidBed(p).offset(4096, 28976), -1024) << "1024 units are left: a quarter";
  EXPECT_EQ(SolidBed(p).offset(4096, 30000), -2048);
  p.heat.enabled = false;
  EXPECT_EQ(SolidBed(p).offset(4096, 0), 2048);
  p.material = {.melting_point = 0, .latent_heat = 65535};
  p.heat.enabled = true;
  EXPECT_EQ(SolidBed(p).offset(4096, 0), 2048) << "w = 65535, scale 4097: 65535 x 4097 >> 16 = 4096";
}

}  // namespace
}  // namespace voxmelt::rule
