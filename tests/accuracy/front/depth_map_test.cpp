// Maps of depth are made of a few cells, and what lies elsewhere is computed by hand.
#include "accuracy/front/depth_map.h"

#include <gtest/gtest.h>

#include "tests/kernel/worlds.h"

namespace voxmelt::accuracy::front {
namespace {

using namespace worlds;

TEST(DepthMap, ColumnsOfASquareAreSummed) {
  Volume v(Grid{9, 4, 9});
  put(v, 0, 0, 0, kOne, 0, 0);
  put(v, 3, 2, 3, kOne / 4, 0, 0);  // the same square of 4 x 4
  put(v, 4, 1, 3, kOne / 2, 0, 0);  // the next one along x
  put(v, 0, 3, 8, kOne / 8, 0, 0);  // the third one along z
  put_solid(v, 1, 1, 1, kOne, 0);   // no liquid
  put_inert(v, 2, 0, 2);
  EXPECT_EQ(map_of(v, 1), (DepthMap{{{0, 0}, 1.25}, {{1, 0}, 0.5}, {{0, 2}, 0.125}}));
}

// A cell of a grid of half the size has 8 cells of the scene's file. Two of them lie along a square's side.
TEST(DepthMap, ACoarserGridHasTheSameSquares) {
  Volume v(Grid{4, 2, 4});
  put(v, 1, 0, 1, kOne, 0, 0);
  put(v, 2, 0, 1, kOne / 2, 0, 0);
  EXPECT_EQ(map_of(v, 0.5), (DepthMap{{{0, 0}, 8.}, {{1, 0}, 4.}}));
}

// On a grid of 0.375 a cell covers 8/3 cells of the scene's file. That at 1 covers 8/3 to 16/3. The second
// square begins at 4, so each has a half of it.
TEST(DepthMap, SquaresShareACellOnTheirBorder) {
  Volume v(Grid{3, 1, 3});
  put(v, 1, 0, 0, kOne, 0, 0);
  put(v, 1, 0, 1, kOne, 0, 0);
  const DepthMap map = map_of(v, 0.375);
  ASSERT_EQ(map.size(), 4u);
  const double cell = 1 / (0.375 * 0.375 * 0.375);
  EXPECT_NEAR(map.at({0, 0}), cell / 2 + cell / 4, 1e-9);
  EXPECT_NEAR(map.at({1, 0}), cell / 2 + cell / 4, 1e-9);
  EXPECT_NEAR(map.at({0, 1}), cell / 4, 1e-9);
  EXPECT_NEAR(map.at({1, 1}), cell / 4, 1e-9);
}

TEST(DepthMap, APartLiesElsewhere) {
  const DepthMap reference{{{0, 0}, 6.}, {{1, 0}, 2.}};
  EXPECT_EQ(part_elsewhere(reference, reference), 0);
  // One of eight cells has moved to the next square: it is missed once and found once.
  EXPECT_DOUBLE_EQ(part_elsewhere({{{0, 0}, 5.}, {{1, 0}, 3.}}, reference), 1. / 8);
  // Both have moved to a square that the reference leaves dry.
  EXPECT_DOUBLE_EQ(part_elsewhere({{{0, 0}, 6.}, {{7, 7}, 2.}}, reference), 2. / 8);
  EXPECT_DOUBLE_EQ(part_elsewhere({{{0, 0}, 6.}}, reference), 1. / 8);  // two have gone, over twice the sum
  EXPECT_EQ(part_elsewhere({}, {}), 0);
}

}  // namespace
}  // namespace voxmelt::accuracy::front
