// Worlds of a few cells show, phase by phase, the neighbours that may exchange at all.
#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>

#include "tests/kernel/worlds.h"

namespace voxmelt::scalar {
namespace {

using namespace worlds;
using step::Phase;

void run(run::Simulation& s, std::initializer_list<Phase> phases) {
  for (const Phase phase : phases) s.run_phase(phase);
}

// A diagonal between two blocked cells is barred, solid or inert. Between a blocked and an open one it is
// not.
TEST(Diagonal, IsBarredBetweenTwoBlockedCells) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
    for (int blocked = 0; blocked < 4; ++blocked) {
      Volume v(Grid{2, 1, 2});
      put(v, 0, 0, 0, kOne, law == rule::Law::paper ? kOne : 0);
      if (blocked & 1) put_solid(v, 1, 0, 0);
      if (blocked & 2) put_inert(v, 0, 0, 1);
      run::Simulation s = simulate(law == rule::Law::paper ? paper_showcase() : viscous(10), v);
      steps(s, 50);
      EXPECT_EQ(amount_at(s, 1, 0, 1) > 0, blocked != 3) << blocked;
    }
}

// Under the viscous law, cells in a run wait for the next settling. Only cells outside runs fall.
TEST(Run, CellsOfARunDoNotFall) {
  Volume v(Grid{3, 8, 3});
  fill(v, {1, 0, 1, 2, 4, 2}, kOne);
  put(v, 0, 5, 0, 700);
  run::Simulation s = simulate(viscous(10), v);
  run(s, {Phase::excess, Phase::spread});
  const Volume before = s.volume();
  ASSERT_LT(amount_at(s, 1, 0, 1), kOne) << "the column gave to all sides";
  run(s, {Phase::gravity});
  for (int y = 0; y < 4; ++y) EXPECT_EQ(amount_at(s, 1, y, 1), before.amount[v.at(1, y, 1)]);
  EXPECT_EQ(amount_at(s, 0, 4, 0), 700);
}

// Under the viscous law, a cell that settling emptied is no part of the run, as if it had never held
// anything.
TEST(Run, EmptiedCellsLeaveIt) {
  Volume merged(Grid{2, 8, 1}), split = merged;
  fill(merged, {0, 0, 0, 1, 6, 1}, kOne);
  fill(split, {0, 0, 0, 1, 6, 1}, kOne);
  put(merged, 1, 0, 0, 2148);
  put(split, 1, 0, 0, 2048);
  put(split, 1, 1, 0, 100);
  run::Simulation one = simulate(viscous(100), merged), two = simulate(viscous(100), split);
  run(one, {Phase::excess, Phase::spread});
  run(two, {Phase::excess, Phase::spread});
  EXPECT_EQ(one.volume().amount, two.volume().amount);
  EXPECT_GT(amount_at(one, 1, 1, 0), 0);
}

// Under the viscous law, the free cell above a run shows that run's head. So nearly level columns exchange
// next to nothing.
TEST(Run, TheCellAboveShowsItsHead) {
  Volume v(Grid{2, 6, 1});
  fill(v, {0, 0, 0, 2, 3, 1}, kOne);
  put(v, 1, 3, 0, 80);  // 5 head units higher
  run::Simulation s = simulate(viscous(100), v);
  run(s, {Phase::excess, Phase::spread});
  EXPECT_LE(80 - amount_at(s, 1, 3, 0), 1);
}

// Under the viscous law, a bed offset raises or lowers the head of the liquid that stands on it.
TEST(Bed, OffsetsDriveAFlow) {
  for (const int offset : {2048, 4095, 0}) {
    Volume v(Grid{2, 4, 1});
    put_inert(v, 0, 0, 0, offset);
    put_inert(v, 1, 0, 0);
    put(v, 0, 1, 0, 2000);
    put(v, 1, 1, 0, 2000);
    run::Simulation s = simulate(viscous(10), v);
    run(s, {Phase::excess, Phase::spread});
    const std::int32_t left = amount_at(s, 0, 1, 0);
    if (offset == 2048) {
      EXPECT_EQ(left, 2000);
    }
    if (offset > 2048) {
      EXPECT_LT(left, 2000);
    }
    if (offset < 2048) {
      EXPECT_GT(left, 2000);
    }
  }
}

// Under the paper's law, nothing spreads in the air if `support` is on. Otherwise it does.
TEST(Support, OnlyWhatStandsSpreads) {
  for (const bool support : {true, false}) {
    Parameters p = paper_showcase();
    p.flow.paper.support = support;
    Volume v(Grid{5, 9, 5});
    put(v, 2, 8, 2, kOne, kOne);
    run::Simulation s = simulate(p, v);
    steps(s, 6);
    EXPECT_EQ(amount_at(s, 2, 2, 2) == kOne, support);
  }
}

// A full column stands under a lid. Neither law moves anything, and nothing rises through the lid.
TEST(Lid, HoldsAFullColumn) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    Volume v(Grid{3, 8, 3});
    fill_inert(v, whole(v.grid));
    for (int y = 1; y < 6; ++y) {
      v.inert.set(1, y, 1, false);
      put(v, 1, y, 1, kOne);
    }
    put(v, 1, 3, 1, 65535);  // over-filled in the middle
    run::Simulation s = simulate(law == rule::Law::paper ? paper_showcase() : viscous(10), v);
    steps(s, 100);
    EXPECT_TRUE(s.drift().none());
    EXPECT_EQ(broken_invariant(s.volume(), s.parameters()), "");
    EXPECT_EQ(amount_at(s, 1, 5, 1), 65535) << "stacked from the lid down";
    EXPECT_EQ(amount_at(s, 1, 6, 1), rule::kBedHalf);
  }
}

}  // namespace
}  // namespace voxmelt::scalar
