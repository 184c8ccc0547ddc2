#include "kernel/automaton/state/bit_plane.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>

namespace voxmelt::state {
namespace {

class BitPlaneWidth : public testing::TestWithParam<int> {};

TEST_P(BitPlaneWidth, EveryBitIsItsOwn) {
  const Grid g{GetParam(), 3, 2};
  BitPlane plane(g);
  EXPECT_EQ(plane.row_words(), static_cast<std::size_t>(g.x + 63) / 64);
  EXPECT_EQ(plane.words().size(), plane.row_words() * 6);
  EXPECT_EQ(plane.count(), 0);
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y)
      for (int x = 0; x < g.x; ++x) {
        plane.set(x, y, z, true);
        EXPECT_TRUE(plane.test(x, y, z));
        EXPECT_EQ(plane.count(), 1) << "and no other";
        EXPECT_EQ(plane.row(y, z)[static_cast<std::size_t>(x / 64)], std::uint64_t{1} << (x % 64));
        plane.set(x, y, z, true);
        EXPECT_EQ(plane.count(), 1);
        plane.set(x, y, z, false);
        EXPECT_EQ(plane.count(), 0);
      }
}

TEST_P(BitPlaneWidth, BitsPastTheGridStayZero) {
  const Grid g{GetParam(), 2, 2};
  BitPlane plane(g), other(g);
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y)
      for (int x = 0; x < g.x; ++x) plane.set(x, y, z, true);
  EXPECT_EQ(plane.count(), static_cast<std::int64_t>(g.cells()));
  EXPECT_FALSE(plane == other);
  for (int x = 0; x < g.x; ++x)
    for (const auto& [y, z] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) other.set(x, y, z, true);
  EXPECT_TRUE(plane == other);
}

INSTANTIATE_TEST_SUITE_P(Widths, BitPlaneWidth, testing::Values(1, 2, 63, 64, 65, 128, 129));

TEST(Grid, IndexIsXFastestYUp) {
  const Grid g{3, 4, 5};
  EXPECT_EQ(g.cells(), 60u);
  EXPECT_EQ(g.index(1, 0, 0), 1u);
  EXPECT_EQ(g.index(0, 1, 0), 3u);
  EXPECT_EQ(g.index(0, 0, 1), 12u);
  EXPECT_EQ(g.index(2, 3, 4), 59u);
  EXPECT_TRUE(g.contains(2, 3, 4));
  for (const auto& [x, y, z] :
       {std::tuple{-1, 0, 0}, {3, 0, 0}, {0, -1, 0}, {0, 4, 0}, {0, 0, -1}, {0, 0, 5}})
    EXPECT_FALSE(g.contains(x, y, z));
}

}  // namespace
}  // namespace voxmelt::state
