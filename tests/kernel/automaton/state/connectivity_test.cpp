#include "kernel/automaton/state/connectivity.h"

#include <gtest/gtest.h>

#include "tests/kernel/worlds.h"

namespace voxmelt::state {
namespace {

using namespace worlds;

TEST(Detached, NothingFloatsInAnEmptyOrStandingWorld) {
  Volume v(Grid{5, 6, 5});
  EXPECT_EQ(count_detached(v), 0);
  for_each({2, 0, 2, 3, 6, 3}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
  EXPECT_EQ(count_detached(v), 0);
}

TEST(Detached, ABowlOnItsStemStandsUntilTheStemMelts) {
  Volume v(Grid{9, 9, 9});
  for_each({4, 0, 4, 5, 4, 5}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
  for_each({2, 4, 2, 7, 6, 7}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
  EXPECT_EQ(count_detached(v), 0);
  v.solid.set(4, 2, 4, false);
  EXPECT_EQ(count_detached(v), 50 + 1);
  put_inert(v, 1, 4, 2);  // and hangs again on a wall beside it
  EXPECT_EQ(count_detached(v), 0);
}

TEST(Detached, EdgesAndCornersDoNotHold) {
  Volume v(Grid{3, 3, 3});
  put_solid(v, 0, 0, 0);
  put_solid(v, 1, 1, 0);
  put_solid(v, 2, 2, 1);
  EXPECT_EQ(count_detached(v), 2);
}

// The borders at the sides and above hold nothing; liquid neither.
TEST(Detached, OnlyTheBottomAndInertHold) {
  Volume v(Grid{3, 3, 3});
  put_solid(v, 0, 2, 0);
  fill(v, {0, 0, 0, 1, 2, 1}, kOne);
  EXPECT_EQ(count_detached(v), 1);
  put_inert(v, 1, 2, 0);
  EXPECT_EQ(count_detached(v), 0);
}

}  // namespace
}  // namespace voxmelt::state
