// Bounds keep numbers in the widths that machines give them. Each test asks for what a reader of the result
// relies on, over all that a scene may say.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <random>

#include "kernel/automaton/rule/relax.h"
#include "kernel/automaton/rule/solid_bed.h"
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

// The same holds where the drop is that of relaxed heads.
TEST(Bounds, ACliffOfRelaxedHeadsGivesAsADropOfOneCell) {
  const Relaxation relaxation{8};
  for (const bool diagonal : {false, true}) {
    const std::int32_t one_cell = diagonal ? 724 * 64 : kRelaxedOne;
    const Column giver = run_column(40 * kOne, 40, 0, 0, fluid(1 << 26), 1, relaxation);
    const Column taker = run_column(8 * kOne, 8, 0, 0, fluid(1 << 26), 1, relaxation);
    const auto flow = [&](std::int32_t fall) {
      return relaxed_flow(giver, kOne, taker, kOne, diagonal, 0, 0, fall, relaxation);
    };
    EXPECT_GT(flow(one_cell), flow(one_cell / 2));
    for (const int times : {2, 20, 2000}) EXPECT_EQ(flow(times * one_cell), flow(one_cell)) << times;
  }
}

// An integrated head has 32 bits, and what neighbours add has room beside it.
TEST(Bounds, AHigherHeadIsNoLessWhenIntegrated) {
  for (int stages = 2; stages <= kMostStages; ++stages) {
    std::int32_t before = 0;
    for (std::int32_t head = 1; head <= (1 << 28); head *= 2) {
      const std::int32_t now = integrated(head, 0, stages, Relaxation{stages});
      ASSERT_TRUE(before <= now && now <= 1 << 30) << head;
      before = now;
    }
  }
}

// A bed lies within half a cell of an upper face, or half a cell above that, where a mould or a melt left
// more than a full cell.
TEST(Bounds, ABedOfAnySolidIsOneThatAnInertCellCanHave) {
  for (const std::int32_t latent_heat : {0, 5000, 40000})
    for (std::int32_t amount = 0; amount <= kAmountMax; amount += 61)
      for (const std::int32_t heat : {0, 20000, 30001, 65535}) {
        const std::int32_t bed = SolidBed(true, 30000 + latent_heat / 2, latent_heat).offset(amount, heat);
        ASSERT_TRUE(-kBedHalf <= bed && bed < kOne) << amount << " " << heat;
      }
}

// Parts of a run pass its faces one after the other. Meanwhile no cell holds more than 16 bits say.
TEST(Bounds, NoCellHoldsMoreThanItMayWhilePartsMove) {
  std::mt19937 random(1);
  constexpr std::size_t kCells = 40;
  int kept = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::array<std::int64_t, kCells> amount{}, below{};  // `below`: sums up to and with each cell
    const std::size_t heap = random() % kCells, heaped = random() % 6;  // cells that hold more than one
    const std::int32_t most = std::array{2 * kOne, 5 * kOne, kAmountMax}[random() % 3];
    std::int64_t mass = 0;
    for (std::size_t k = 0; k < kCells; ++k) {
      amount[k] = random() % (heap <= k && k < heap + heaped ? most : kOne / 4);
      below[k] = mass += amount[k];
    }
    bool keeps = mass <= std::int64_t{kCells} * kOne;
    const auto excess = [&](std::size_t k) { return face_excess(below[k], static_cast<std::int32_t>(k)); };
    for (std::size_t k = 0; k + 1 < kCells; ++k) keeps = keeps && keeps_order_at(excess(k));
    if (!keeps) continue;
    ++kept;
    const auto move = [&](std::size_t giver, std::size_t taker, std::int64_t part) {
      amount[giver] -= part;
      amount[taker] += part;
      ASSERT_GE(amount[giver], 0);
      ASSERT_LE(amount[taker], kAmountMax);
    };
    for (std::size_t k = 0; k + 1 < kCells; ++k) move(k, k + 1, settles_up(excess(k)));
    for (std::size_t k = kCells - 1; k-- > 0;)
      move(k + 1, k, settles_down(mass, below[k], static_cast<std::int32_t>(k)));
  }
  EXPECT_GT(kept, 100);
}

// Whole numbers stand for these, and none is more than half a unit off.
TEST(Bounds, DeadZoneAndMobilityRoundToTheNearest) {
  for (const std::int64_t mass : {16, 1000, 4096, 23456, 100000})
    for (const int yield : {1, 7, 300, 5000, 65535}) {
      Flow flow = fluid(99999999);
      flow.viscous.yield = static_cast<std::uint16_t>(yield);
      const std::int64_t depth = mass >> 4, dead = run_column(mass, 30, 0, 0, flow).dead;
      EXPECT_TRUE(dead == 1 || std::abs(dead * depth - 2 * yield) * 2 <= depth) << mass << " " << yield;
      const std::int64_t exact = 99999999 * (mass * mass >> 8);  // in 1/2^48
      EXPECT_LE(std::abs((run_mobility(mass, 0, flow, 1) << 24) - exact), 1 << 23) << mass;
    }
}

// A film of single units still has an amount that flows into what is dry.
TEST(Bounds, WhatFlowsOfSomethingIsSomething) {
  const Column giver = run_column(1, 1, 0, 0, fluid(1)), taker = bed_column(0);
  for (std::int32_t amount = 1; amount < 100; ++amount)
    EXPECT_GE(2 * flowing_amount(giver, amount, taker, 0), amount);
}

// However high a cliff is, a table of 512 words has its factor. Liquid that stands on it still flows over.
TEST(Bounds, WhatFlowsOverACliffIsANinthOrMore) {
  for (const bool diagonal : {false, true})
    for (std::int32_t height = 32; height <= 16 * kTallest; height += 1 + height / 3) {
      const std::int32_t rise = bed_rise(0, height);
      for (const std::int32_t across : {0, rise})
        ASSERT_GE(slope_factor(rise, across, diagonal, 0), 16384 / 9) << height;
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
