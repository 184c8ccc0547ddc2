// Bounds keep numbers in the widths that machines give them. Each test asks for what a reader of the result
// relies on, over all that a scene may say.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>

#include "kernel/automaton/rule/relax.h"
#include "kernel/automaton/rule/viscous.h"

namespace voxmelt::rule {
namespace {

constexpr std::int64_t kTallest = 32768;                                   // cells
constexpr std::uint64_t kMostMobile = (std::uint64_t{1} << 32) * 142 / 9;  // kappa 71

Flow fluid(std::uint64_t mobility, int stiffness = 8) {
  Flow flow;
  flow.law = Law::viscous;
  flow.viscous.mobility = mobility;
  flow.viscous.stiffness = static_cast<std::uint8_t>(stiffness);
  return flow;
}

TEST(Bounds, ADeeperRunIsNoLessMobile) {
  const Flow flow = fluid(kMostMobile);
  std::int64_t before = 0;
  for (std::int64_t depth = 1; depth <= 16 * kTallest; depth += 1 + depth / 8) {
    const std::int64_t mobility = run_mobility(depth * kOne, 0, flow, 1);
    ASSERT_GE(mobility, before) << depth;
    before = mobility;
  }
}

TEST(Bounds, ARunOfAnyDepthNeedsAFiniteNumberOfSubsteps) {
  const Flow flow = fluid(std::uint64_t{1} << 32);
  for (std::int64_t n = 1; n <= kTallest; n *= 2) {
    const std::int64_t full = n * kOne;
    const auto cells = static_cast<std::int32_t>(n);
    for (const std::int64_t mass : {full, full + n, n * kAmountMax})
      EXPECT_GT(needed_substeps(mass, cells, 0, flow), 0) << n << " " << mass;
  }
}

// A flank has no head on its other side that would answer. So a drop must not lose more than an eighth at
// once.
TEST(Bounds, ABareFlankGivesAnEighthAtMost) {
  for (const std::uint64_t mobility : {std::uint64_t{1} << 20, std::uint64_t{1} << 30, kMostMobile})
    for (const std::int64_t depth : {1, 3, 60})
      for (const std::int32_t amount : {100, 2048, 4096}) {
        const std::int64_t mass = (depth - 1) * kOne + amount;
        const Column giver = run_column(mass, static_cast<std::int32_t>(depth), 0, 0, fluid(mobility));
        const Column taker = air_column(static_cast<int>(depth) - 1);
        for (const int walls : {0, 4})
          EXPECT_LE(viscous_flow(giver, amount, taker, 0, false, 0, walls), amount / 8 + 1);
      }
}

// In one stage a pair levels no more than its difference. Else it swings.
TEST(Bounds, AStageLevelsNoMoreThanTheDifference) {
  for (int stages = 2; stages <= kMostStages; ++stages) {
    const Relaxation relaxation{stages};
    const std::int64_t most = (std::int64_t{1} << (24 + relaxation.bits())) - 1;
    for (const std::int32_t cells : {1, 7, 1000, 32768})
      for (const std::int32_t slope : {1, 16384, 24576}) {
        const std::int32_t part = leveling(most, slope, cells, false, relaxation);
        for (const std::int32_t difference : {1, 10000, 1 << 20, 1 << 30}) {
          const std::int32_t given = leveled(difference, part, 1, relaxation);
          ASSERT_TRUE(0 <= given && given <= difference) << stages << " " << cells << " " << slope;
        }
      }
  }
}

// However much pours in from eight neighbours, a cell rises, and by less than the 32 cells that 21 bits of
// impetus can say.
TEST(Bounds, WhatACellTakesMakesItRise) {
  for (const std::int32_t taken : {1000, 65535, 8 * 65535, 1 << 30}) {
    Relaxing cell;
    for (int j = 2; j <= kMostStages; ++j) {
      const std::int32_t before = cell.change;
      cell.add(taken, 0, j);
      ASSERT_GT(cell.change, before) << taken << " stage " << j;
      ASSERT_LT(std::abs(cell.impetus), 32 * kRelaxedOne) << taken << " stage " << j;
    }
  }
}

// A difference between neighbours counts as one cell at most, as a drop does in the flow. So a cliff does
// not run ahead of what its liquid can do.
TEST(Bounds, ACliffLevelsAsADropOfOneCell) {
  const Relaxation relaxation{8};
  for (int j = 1; j <= 8; ++j) {
    const std::int32_t one_cell = relaxation.time(j) / 2;
    EXPECT_EQ(leveled(20 * one_cell, 65535, j, relaxation), leveled(one_cell, 65535, j, relaxation));
  }
}

// K sub-steps carry what one step does, but for half a unit each.
TEST(Bounds, SubstepsShareThePaceToHalfAUnit) {
  for (const std::uint64_t mobility : {1000, 54321, 1234567})
    for (const int n : {2, 3, 7, 100, 1000}) {
      constexpr std::int64_t kDepth = 64 * kOne;
      const std::int64_t whole = run_mobility(kDepth, 0, fluid(mobility), 1);
      const std::int64_t shared = n * run_mobility(kDepth, 0, fluid(mobility), n);
      // Half a unit of pace is that of mobility times 2^28 / 2^24, and each rounds once more.
      EXPECT_LE(std::abs(whole - shared), n * 8 + n / 2 + 1) << mobility << " " << n;
    }
}

}  // namespace
}  // namespace voxmelt::rule
