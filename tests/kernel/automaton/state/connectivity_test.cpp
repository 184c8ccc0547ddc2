#include "kernel/automaton/state/connectivity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

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
  put_inert(v, 1, 4, 2);  // it hangs again, on a wall beside it
  EXPECT_EQ(count_detached(v), 0);
}

TEST(Detached, EdgesAndCornersDoNotHold) {
  Volume v(Grid{3, 3, 3});
  put_solid(v, 0, 0, 0);
  put_solid(v, 1, 1, 0);
  put_solid(v, 2, 2, 1);
  EXPECT_EQ(count_detached(v), 2);
}

// The borders at the sides and above hold nothing, and neither does liquid.
TEST(Detached, OnlyTheBottomAndInertHold) {
  Volume v(Grid{3, 3, 3});
  put_solid(v, 0, 2, 0);
  fill(v, {0, 0, 0, 1, 2, 1}, kOne);
  EXPECT_EQ(count_detached(v), 1);
  put_inert(v, 1, 2, 0);
  EXPECT_EQ(count_detached(v), 0);
}

// Counts cell by cell, from neighbour to neighbour.
std::int64_t detached_plainly(const Volume& v) {
  const Grid g = v.grid;
  std::set<std::array<int, 3>> held;
  std::vector<std::array<int, 3>> ways;
  const auto reach = [&](int x, int y, int z) {
    if (g.contains(x, y, z) && v.solid.test(x, y, z) && held.insert({x, y, z}).second)
      ways.push_back({x, y, z});
  };
  const auto around = [](int x, int y, int z) {
    return std::array<std::array<int, 3>, 6>{
        {{x - 1, y, z}, {x + 1, y, z}, {x, y - 1, z}, {x, y + 1, z}, {x, y, z - 1}, {x, y, z + 1}}};
  };
  for_each({0, 0, 0, g.x, g.y, g.z}, [&](int x, int y, int z) {
    if (y == 0) reach(x, y, z);
    if (!v.inert.test(x, y, z)) return;
    for (const auto& [bx, by, bz] : around(x, y, z)) reach(bx, by, bz);
  });
  while (!ways.empty()) {
    const auto [x, y, z] = ways.back();
    ways.pop_back();
    for (const auto& [bx, by, bz] : around(x, y, z)) reach(bx, by, bz);
  }
  return v.solid.count() - static_cast<std::int64_t>(held.size());
}

// The widths are below one word, a whole one, and more. The worlds are sponges in which ways are long, and
// dust.
TEST(Detached, ASpongeIsThatOfAPlainWalk) {
  std::mt19937 random(19);
  std::int64_t most = 0, least = 1 << 30;
  for (int world = 0; world < 60; ++world) {
    constexpr std::array<int, 5> widths{1, 63, 64, 65, 150};
    Volume v(Grid{widths[static_cast<std::size_t>(world) % widths.size()], 9, 8});
    const std::uint32_t dense = 20 + 10 * static_cast<std::uint32_t>(world % 7);  // per cent
    for_each({0, 0, 0, v.grid.x, v.grid.y, v.grid.z}, [&](int x, int y, int z) {
      if (random() % 100 < dense)
        put_solid(v, x, y, z);
      else if (random() % 200 == 0)
        put_inert(v, x, y, z);
    });
    const std::int64_t expected = detached_plainly(v);
    EXPECT_EQ(count_detached(v), expected) << "world " << world;
    most = std::max(most, expected);
    least = std::min(least, expected);
  }
  EXPECT_GT(most, 500);
  EXPECT_LT(least, 10);
}

}  // namespace
}  // namespace voxmelt::state
