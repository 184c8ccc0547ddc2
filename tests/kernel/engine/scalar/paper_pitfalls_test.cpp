// Prototypes of the paper's law had these errors. Each has its number (under the showcase parameters).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "kernel/automaton/state/connectivity.h"
#include "tests/kernel/measure.h"

namespace voxmelt::scalar {
namespace {

using namespace worlds;

// Runs n steps and returns the largest amount seen, in cells.
double run_and_watch(run::Simulation& s, int n) {
  std::int32_t largest = 0;
  for (int i = 0; i < n; ++i) {
    s.step();
    largest = std::max(largest, largest_amount(s.volume()));
  }
  return largest / 4096.0;
}

// Starved liquid (no energy) pours on a floor. With slump, the largest amount measured is 1.03 of 16, in a
// heap of slope 1/4. Without it, one tower reaches the ceiling, with 16 of 16 in every cell.
TEST(Pitfall, TowersOfStarvedLiquid) {
  for (const bool slump : {true, false}) {
    Parameters p = paper_showcase();
    if (!slump) p.flow.paper.slump = 0;
    p.vents = {{{{16 * 12 + 8, 16 * 20 + 8, 16 * 12 + 8}, 20}, 1500, 0, 0, 0, 400}};
    run::Simulation s = simulate(p, Volume(Grid{24, 24, 24}));
    const double largest = run_and_watch(s, 400);
    steps(s, 200);
    const double highest = heights(s.volume()).highest();
    RecordProperty("largest", std::to_string(largest));
    RecordProperty("highest", std::to_string(highest));
    if (slump) {
      EXPECT_LE(largest, 1.5);
      EXPECT_LE(highest, 10);
    } else {
      EXPECT_GT(largest, 15.9) << "the pitfall is gone: does slump still have a purpose?";
      EXPECT_GT(highest, 24);
    }
    EXPECT_TRUE(s.drift().none());
  }
}

// |a4 - 1| of heaps at rest was measured with eight seeds. Drops have 2.5 % on average and at most 3.3 %, and
// a starved pile has 10 %. The diagonal's margin decides: 8/8 gives 0.3 % and -8 %, 9/8 0.4 % and 0.3 %, 11/8
// 2.5 % and 10 %.
constexpr double kRoundDrop = 0.012, kRoundPile = 0.02;

// Measurements with eight seeds found rest after 560 to 880 steps, 3 to 14 cells of dust among 1500, and a
// largest amount of 1.45.
TEST(Drop, ComesToRestWithoutDustAndRound) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Parameters p = paper_showcase();
    p.seed = seed;
    Volume v(Grid{49, 14, 49});
    put_ball(v, 6, true);
    run::Simulation s = simulate(p, v);
    EXPECT_LE(run_and_watch(s, 1100), 2.5) << "over-filling";
    EXPECT_EQ(moving_steps(s, 100), 0) << "a film creeps";
    const int cells = static_cast<int>(s.volume().liquid.count());
    EXPECT_GT(cells, 1000);
    EXPECT_LE(dust(s.volume(), 64), cells / 50) << "cells under 1/64";
    const Spread spread = spread_of(heights(s.volume()));
    EXPECT_LE(spread.anisotropy, kRoundDrop);
    EXPECT_GT(spread.radius, 10);
    RecordProperty("anisotropy", std::to_string(spread.anisotropy));
  }
}

TEST(Drop, APileOfStarvedLiquidIsRound) {
  Parameters p = paper_showcase();
  p.vents = {{{{16 * 16 + 8, 16 * 16 + 8, 16 * 16 + 8}, 20}, 1000, 0, 0, 0, 300}};
  run::Simulation s = simulate(p, Volume(Grid{33, 20, 33}));
  steps(s, 600);
  const Spread spread = spread_of(heights(s.volume()));
  EXPECT_LE(spread.anisotropy, kRoundPile);
  RecordProperty("anisotropy", std::to_string(spread.anisotropy));
}

// Makes a pool that keeps all its energy (alpha 1, threshold 0), from a rough start.
run::Simulation hot_pool(bool downhill, int margin, double depth) {
  Parameters p = paper_showcase();
  p.flow.paper.threshold = p.flow.paper.slump = 0;
  p.flow.paper.alpha_liquid = p.flow.paper.alpha_solid = p.flow.paper.alpha_floor = 65535;
  p.flow.paper.downhill = downhill;
  p.flow.paper.margin = static_cast<rule::Amount>(margin);
  Volume v(Grid{24, 5, 24});
  Random random(4);
  for_each({0, 0, 0, 24, 1, 24}, [&](int x, int y, int z) {
    const std::int32_t a = static_cast<std::int32_t>(depth * kOne) + random.between(-1500, 1500);
    put(v, x, y, z, a, a);
  });
  return simulate(p, v);
}

// The roughness measured is 0.018 and 0.017 cells. The literal reading (downhill off) gives 0.12 and 0.26.
TEST(Pitfall, CheckerboardInAHotPool) {
  for (const double depth : {0.5, 1.5}) {
    run::Simulation s = hot_pool(true, 256, depth);
    steps(s, 1000);
    EXPECT_LE(roughness(heights(s.volume())), 0.05);
    run::Simulation literal = hot_pool(false, 256, depth);
    steps(literal, 1000);
    EXPECT_GT(roughness(heights(literal.volume())), 0.05) << "what downhill is for";
  }
}

// In this form of the law `downhill` (lower by the flow itself) lets a pool rest, with and without a margin.
// Read literally, the pool moves for ever.
TEST(Pitfall, HotPoolNeverQuiet) {
  for (const double depth : {0.5, 1.5}) {
    for (const int margin : {0, 256}) {
      run::Simulation s = hot_pool(true, margin, depth);
      steps(s, 1000);
      EXPECT_EQ(moving_steps(s, 200), 0) << "margin " << margin;
    }
    run::Simulation literal = hot_pool(false, 256, depth);
    steps(literal, 1000);
    EXPECT_EQ(moving_steps(literal, 200), 200);
  }
}

// Liquid oozes from the underside of a ceiling. Falling cells under 1/16 are counted over all steps: with
// drip there are none.
// An older form read "p is air" by the masks of the phase's begin. It let a thread of mist follow the first
// drop for ever (measured 4725, without drip 5355). The present amount of p, instead of its mask, gives 0,
// and 144 drops.
TEST(Pitfall, OverhangRainsMist) {
  for (const bool drip : {true, false}) {
    Parameters p = paper_showcase();
    p.flow.fall.hang = drip ? 1024 : 0;
    for (const int x : {3, 6, 9})
      p.vents.push_back({{{16 * x + 8, 16 * 10 + 8, 16 * 6 + 8}, 8}, 30, 0, 4096, 0, 300});
    Volume v(Grid{13, 14, 13});
    for_each({1, 11, 1, 12, 12, 12}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
    run::Simulation s = simulate(p, v);
    int mist = 0, drops = 0;
    for (int i = 0; i < 300; ++i) {
      s.step();
      for_each({0, 4, 0, 13, 10, 13}, [&](int x, int y, int z) {  // between the ceiling and the floor
        const std::int32_t a = amount_at(s, x, y, z);
        mist += a > 0 && a < 256;
        drops += a >= 1024;
      });
    }
    if (drip) {
      EXPECT_EQ(mist, 0);
      EXPECT_GT(drops, 50);
    } else {
      EXPECT_GT(mist, 1000);
    }
  }
}

// The stem of a goblet melts through. The bowl stays where it is, and is counted.
TEST(Pitfall, FloatingBowl) {
  Parameters p = paper_showcase();
  p.heat.enabled = true;
  Volume v(Grid{13, 13, 13});
  for_each({6, 0, 6, 7, 6, 7}, [&](int x, int y, int z) { put_solid(v, x, y, z, kOne, y == 3 ? 40000 : 0); });
  for_each({3, 6, 3, 10, 8, 10}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
  run::Simulation s = simulate(p, v);
  EXPECT_EQ(state::count_detached(s.volume()), 0);
  s.step();
  EXPECT_EQ(state::count_detached(s.volume()), 98 + 2);
}

// The paper's law has no hydrostatics: a U-tube stays as it is, 21 against 3. The viscous law levels it.
TEST(Pitfall, UTubeDoesNotLevel) {
  Volume v = u_tube();
  for_each(whole(v.grid), [&](int x, int y, int z) {
    if (v.liquid.test(x, y, z)) v.energy[v.at(x, y, z)] = kOne;
  });
  run::Simulation s = simulate(paper_showcase(), v);
  steps(s, 1000);
  const Heights h = heights(s.volume());
  EXPECT_NEAR(h(2, 2), 21, 0.5);
  EXPECT_NEAR(h(8, 2), 3, 0.5);
}

}  // namespace
}  // namespace voxmelt::scalar
