// Prototypes of the viscous law had these errors, each with its number.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/kernel/measure.h"

namespace voxmelt::scalar {
namespace {

using namespace worlds;
using step::Phase;

// Measurements found rest after 3150 steps at 11.48 and 11.46 of 12. The tunnel holds the missing half cells.
TEST(UTube, Levels) {
  run::Simulation s = simulate(viscous(0.02, 0.002), u_tube());
  steps(s, 3300);
  const Heights h = heights(s.volume());
  EXPECT_NEAR(h(2, 2), h(8, 2), 0.1);
  for (const int x : {1, 2, 3, 7, 8, 9}) EXPECT_NEAR(h(x, 2), 12, 1.2) << "volume error of the column";
  EXPECT_EQ(moving_steps(s, 100), 0);
  RecordProperty("levels", std::to_string(h(2, 2)) + " " + std::to_string(h(8, 2)));
}

// Truncation froze films (their radius lagged by 16 to 22 %). The growth measured now is 1.08 per doubling of
// time, where t^(1/8) gives 1.09.
TEST(Film, GoesOnSpreading) {
  Volume v(Grid{49, 3, 49});
  put_disc(v, 8, 0.5);
  run::Simulation s = simulate(viscous(2), v);
  std::vector<double> radius;
  for (const int n : {500, 500, 1000}) {
    steps(s, n);
    radius.push_back(spread_of(heights(s.volume())).radius);
  }
  EXPECT_GT(radius[1], 1.06 * radius[0]);
  EXPECT_GT(radius[2], 1.06 * radius[1]);
}

// With a yield stress, measurements found rest at radius 7.09 and |a4 - 1| 1.9 % (a film of 0.5 cells).
TEST(Film, ComesToRestWithYield) {
  Volume v(Grid{41, 3, 41});
  put_disc(v, 8, 0.5);
  run::Simulation s = simulate(viscous(2, 0.01), v);
  steps(s, 5000);
  EXPECT_EQ(moving_steps(s, 200), 0);
  const Spread spread = spread_of(heights(s.volume()));
  EXPECT_LE(spread.anisotropy, 0.03);
  EXPECT_GT(spread.radius, 6.5);
}

// Heads alone squeezed a ball of liquid in a mould: its middle emptied, and its rim held up to 1.7.
TEST(Vault, WhatFillsItStaysInIt) {
  Volume v(Grid{12, 12, 12});
  for_each({0, 0, 0, 12, 12, 12}, [&](int x, int y, int z) {
    const double dx = x - 5.5, dy = y - 5.5, dz = z - 5.5;
    if (dx * dx + dy * dy + dz * dz < 25)
      put(v, x, y, z, kOne);
    else
      fill_inert(v, {x, y, z, x + 1, y + 1, z + 1});
  });
  run::Simulation s = simulate(viscous(0.2), v);
  steps(s, 20);
  EXPECT_EQ(s.volume().amount, v.amount);
}

// A chamber is three columns wide, and the middle one is two cells higher, so its head is. It gives only if
// it is not shut, or its neighbour is not.
TEST(Vault, ColumnsGiveUnlessBothAreShut) {
  const auto top_after_a_step = [](int middle, int side) {
    Volume v(Grid{5, 6, 3});
    fill_inert(v, {0, 0, 0, 5, 6, 3});
    for (int x = 1; x <= 3; ++x)
      for (int y = 1; y <= (x == 2 ? 4 : 2); ++y) {
        v.inert.set(x, y, 1, false);
        const int top = x == 2 ? 4 : 2;
        put(v, x, y, 1, kOne + (y == top ? (x == 2 ? middle : side) : 0));
      }
    run::Simulation s = simulate(viscous(0.2), v);
    s.step();
    return s.volume().amount[v.at(1, 2, 1)] - kOne - side;
  };
  EXPECT_EQ(top_after_a_step(0, 0), 0);
  EXPECT_EQ(top_after_a_step(64, -64), 0);
  EXPECT_GT(top_after_a_step(65, 0), 0);
  EXPECT_GT(top_after_a_step(0, -65), 0);
}

// This is the dead zone: heads that differ by one unit do not flow, so a level pool has exactly no flow.
TEST(Pool, LevelToOneHeadUnitDoesNotMove) {
  for (const int depth : {1, 2, 5})
    for (const int part : {100, 2000, 4000}) {
      Volume v(Grid{12, 8, 11});
      Random random(6);
      fill(v, {0, 0, 0, 12, depth, 11}, kOne);
      for_each({0, depth, 0, 12, depth + 1, 11},
               [&](int x, int y, int z) { put(v, x, y, z, part + random.below(8)); });
      run::Simulation s = simulate(viscous(100), v);
      steps(s, 300);
      EXPECT_EQ(s.volume().amount, v.amount);
    }
}

TEST(Pool, CheckerboardGoesFlat) {
  Volume v(Grid{20, 8, 20});
  fill(v, {0, 0, 0, 20, 3, 20}, kOne);
  for_each({0, 3, 0, 20, 4, 20}, [&](int x, int, int z) {
    put(v, x, 3, z, (x + z) % 2 ? kOne : 1000);
    put(v, x, 4, z, (x + z) % 2 ? 500 : 0);
  });
  run::Simulation s = simulate(viscous(0.02), v);
  steps(s, 1500);
  EXPECT_EQ(moving_steps(s, 100), 0);
  EXPECT_LE(roughness(heights(s.volume())), 0.005);
}

// While all layers of a run rounded together, a pool of 32 layers moved for ever.
TEST(Pool, ADeepOneComesToRest) {
  Volume v(Grid{8, 36, 8});
  Random random(9);
  fill(v, {0, 0, 0, 8, 32, 8}, kOne);
  for_each({0, 32, 0, 8, 33, 8}, [&](int x, int y, int z) { put(v, x, y, z, random.between(1, kOne)); });
  run::Simulation s = simulate(viscous(0.02), v);
  steps(s, 1000);
  EXPECT_EQ(moving_steps(s, 100), 0);
}

// A block in free air falls whole, one cell per step, without smear, under both laws.
TEST(Fall, OneCellPerStepWithoutSmear) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    Parameters p = law == rule::Law::paper ? paper_showcase() : viscous(0.02);
    p.flow.paper.slump = 0;
    Volume v(Grid{9, 30, 9});
    Random random(8);
    for_each({3, 24, 3, 6, 29, 6}, [&](int x, int y, int z) { put(v, x, y, z, random.between(1, kOne)); });
    run::Simulation s = simulate(p, v);
    for (int fallen = 1; fallen <= 24; ++fallen) {
      s.step();
      Volume expected(v.grid);
      for_each({3, 24, 3, 6, 29, 6},
               [&](int x, int y, int z) { put(expected, x, y - fallen, z, v.amount[v.at(x, y, z)]); });
      ASSERT_EQ(s.volume().amount, expected.amount) << "after " << fallen << " steps";
    }
  }
}

// Liquid falling on a pool's film does not count for its height, so the pool below does not move yet.
TEST(Fall, AStreamDoesNotRaiseTheHead) {
  Volume v(Grid{11, 30, 11});
  fill(v, {0, 0, 0, 11, 1, 11}, kOne);
  fill(v, {0, 1, 0, 11, 2, 11}, 800);
  fill(v, {5, 2, 5, 6, 28, 6}, kOne);  // directly above
  run::Simulation s = simulate(viscous(10), v);
  s.begin_step();
  for (const Phase phase : {Phase::source, Phase::heat, Phase::melt, Phase::excess, Phase::spread})
    s.run_phase(phase);
  EXPECT_EQ(s.volume().amount, v.amount);
}

// Falling liquid fills a cell to ONE and no more, and cells in the air take no more sideways either.
TEST(Fall, CellsInTheAirHoldAtMostOne) {
  Parameters p = viscous(0.1, 0.002);
  p.flow.fall.wall_factor = 8192;
  p.vents = {{{{16 * 8, 16 * 16, 16 * 8}, 30}, 3000, 0, 0, 0, 300}};
  Volume v(Grid{16, 20, 16});
  fill_inert(v, {3, 8, 3, 11, 9, 11});  // a table to flow over
  fill_inert(v, {0, 0, 0, 3, 4, 16});
  run::Simulation s = simulate(p, v);
  for (int i = 0; i < 400; ++i) {
    Volume before(v.grid);
    step_by_phase(s, [&](Phase phase) {
      const Volume& now = s.volume();
      if (phase == Phase::gravity || phase == Phase::spread)
        for_each({0, 1, 0, 16, 20, 16}, [&](int x, int y, int z) {
          const bool air_below = !before.inert.test(x, y - 1, z) && before.amount[now.at(x, y - 1, z)] == 0;
          if (air_below && before.amount[now.at(x, y, z)] <= kOne) {
            ASSERT_LE(now.amount[now.at(x, y, z)], kOne) << x << ' ' << y << ' ' << z << " step " << i;
          }
        });
      before = now;
    });
  }
  EXPECT_TRUE(s.drift().none());
}

// A funnel of one cell empties a basin of 243 cells but for a film. 27 of them were left after 3000 steps.
TEST(Funnel, OfOneCellEmpties) {
  Volume v(Grid{9, 14, 9});
  fill_inert(v, {0, 6, 0, 9, 7, 9});
  v.inert.set(4, 6, 4, false);
  put(v, 4, 6, 4, 0);
  fill(v, {0, 7, 0, 9, 10, 9}, kOne);
  run::Simulation s = simulate(viscous(0.5), v);
  const auto above = [&] {
    std::int64_t sum = 0;
    for_each({0, 7, 0, 9, 14, 9}, [&](int x, int y, int z) { sum += amount_at(s, x, y, z); });
    return static_cast<double>(sum) / kOne;
  };
  EXPECT_EQ(above(), 243);
  steps(s, 200);
  EXPECT_LT(above(), 200) << "it flows";
  steps(s, 2800);
  EXPECT_LT(above(), 40);
  EXPECT_TRUE(s.drift().none());
  RecordProperty("left", std::to_string(above()));
}

// The largest amount measured is 1.05, in a drop and a pour: outside closed conduits nothing is squeezed. A
// vent three cells high must bring less than a cell per step in all. Otherwise its own cells fill up, as no
// column falls faster.
TEST(OverFilling, StaysUnderFiveQuarters) {
  Volume v(Grid{41, 16, 41});
  put_ball(v, 6, false, 2);
  Parameters p = viscous(0.05, 0.002);
  p.vents = {{{{16 * 8, 16 * 12, 16 * 8}, 24}, 1000, 0, 0, 0, 200}};
  run::Simulation s = simulate(p, v);
  std::int32_t largest = 0;
  for (int i = 0; i < 300; ++i)
    step_by_phase(s, [&](Phase phase) {
      if (phase != Phase::source) largest = std::max(largest, largest_amount(s.volume()));
    });
  EXPECT_LE(largest / 4096.0, 1.25);
  RecordProperty("largest", std::to_string(largest / 4096.0));
}

}  // namespace
}  // namespace voxmelt::scalar
