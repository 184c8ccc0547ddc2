// Isothermal walls are tested by hand: what a cell takes from them, and how two of them act on a bar between
// them.
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

#include "tests/kernel/worlds.h"

namespace voxmelt::scalar {
namespace {

using namespace worlds;

Parameters conducting(std::uint16_t face) {
  Parameters p = paper_showcase();
  p.heat.enabled = p.heat.walls = true;
  p.heat.weight_face = face;
  p.material.melting_point = 65535;
  return p;
}

void put_wall(Volume& v, int x, int y, int z, std::int32_t heat) {
  put_inert(v, x, y, z);
  v.heat[v.at(x, y, z)] = static_cast<std::uint16_t>(heat);
}

std::int32_t heat_of(const run::Simulation& s, int x, int y, int z) {
  return s.volume().heat[s.volume().at(x, y, z)];
}

// The cell takes an eighth of 40,000 at step 0, where D(0, 0, 3) = 0. The wall keeps its heat, and the ledger
// names the wall as giver: 5,000 to a cell of amount 3,000.
TEST(Walls, GiveAndKeep) {
  Volume v(Grid{2, 1, 1});
  put_wall(v, 0, 0, 0, 60000);
  put_solid(v, 1, 0, 0, 3000, 20000);
  run::Simulation s = simulate(conducting(8192), v);
  s.step();
  EXPECT_EQ(heat_of(s, 0, 0, 0), 60000);
  EXPECT_EQ(heat_of(s, 1, 0, 0), 25000);
  EXPECT_EQ(s.ledger().heat.walls, 3000 * 5000);
  EXPECT_EQ(s.ledger().heat.conducted, 0);
  EXPECT_TRUE(s.drift().none());
}

// A cold wall takes. A pair of walls, a wall beside air, and inert cells without heat do nothing.
TEST(Walls, TakeAndDoNothingElse) {
  Volume v(Grid{8, 1, 1});
  put_solid(v, 0, 0, 0, kOne, 40000);
  put_wall(v, 1, 0, 0, 8000);
  put_wall(v, 2, 0, 0, 60000);  // air beside it
  put_wall(v, 4, 0, 0, 60000);
  put_inert(v, 5, 0, 0);
  put_solid(v, 6, 0, 0, kOne, 30000);
  const Volume start = v;
  run::Simulation s = simulate(conducting(8192), v);
  s.step();
  EXPECT_EQ(heat_of(s, 0, 0, 0), 36000);
  EXPECT_EQ(s.ledger().heat.walls, -4000 * kOne);
  Volume expected = start;
  expected.heat[expected.at(0, 0, 0)] = 36000;
  EXPECT_TRUE(s.volume() == expected);
}

// The pass is synchronous: a cell between a wall and another cell takes from both by its heat before. The
// temperature of a wall is that of matter of its heat. 50,000 with 20,000 of latent heat above 25,000 is
// 30,000, and 40,000 is the melting point itself.
TEST(Walls, SameInstantAsMatterAndSameTemperature) {
  Parameters p = conducting(8192);
  p.material = {25000, 20000};
  for (const auto& [wall, gain] : {std::pair(50000, 2000), std::pair(40000, 1375)}) {
    Volume v(Grid{3, 1, 1});
    put_wall(v, 0, 0, 0, wall);
    put_solid(v, 1, 0, 0, kOne, 14000);
    put_solid(v, 2, 0, 0, kOne, 22000);
    run::Simulation s = simulate(p, v);
    s.step();
    EXPECT_EQ(heat_of(s, 1, 0, 0), 14000 + gain + 1000);
    EXPECT_EQ(heat_of(s, 2, 0, 0), 22000 - 1000);
    EXPECT_EQ(s.ledger().heat.walls, gain * kOne);
  }
}

// Heat passes over an edge with 18 neighbours, and over a corner with 26. The weight is that of the distance.
TEST(Walls, OverEdgesAndCorners) {
  for (const int neighbours : {6, 18, 26})
    for (const bool corner : {false, true}) {
      Parameters p = conducting(8192);
      p.heat.neighbours = neighbours;
      p.heat.weight_edge = 4096;
      p.heat.weight_corner = 2048;
      Volume v(Grid{2, 2, 2});
      put_solid(v, 0, 0, 0, kOne, 20000);
      put_wall(v, 1, 1, corner ? 1 : 0, 52000);
      run::Simulation s = simulate(p, v);
      s.step();
      const int gain = corner ? (neighbours == 26 ? 1000 : 0) : (neighbours >= 18 ? 2000 : 0);
      EXPECT_EQ(heat_of(s, 0, 0, 0), 20000 + gain) << neighbours << (corner ? " corner" : " edge");
    }
}

// A bar of 31 cells between walls of 10,000 and 58,000 ends with equal steps of 1,500 from cell to cell.
TEST(Walls, ABarBetweenTwoEndsInAStraightLine) {
  Volume v(Grid{33, 1, 1});
  put_wall(v, 0, 0, 0, 10000);
  put_wall(v, 32, 0, 0, 58000);
  for (int x = 1; x < 32; ++x) put_solid(v, x, 0, 0, kOne, 65535);
  run::Simulation s = simulate(conducting(10922), v);
  steps(s, 20000);
  for (int x = 0; x < 33; ++x) EXPECT_NEAR(heat_of(s, x, 0, 0), 10000 + 1500 * x, 3) << x;
  EXPECT_TRUE(s.drift().none());
}

}  // namespace
}  // namespace voxmelt::scalar
