// An open border takes the liquid of the outermost cells along x and z, and nothing else. The sums that the
// books must have are computed by hand.
#include <cstdint>
#include <string>
#include <vector>

#include "tests/kernel/engine/parallel/equal.h"

namespace voxmelt::scalar {
namespace {

using namespace worlds;
using step::Phase;

std::vector<std::string> everybody() {
  std::vector<std::string> names = fast_implementations();
  names.emplace_back("reference");
  return names;
}

Parameters with_open_border() {
  Parameters p = paper_showcase();
  p.heat.enabled = true;
  p.open_border = true;
  return p;
}

// Runs the phase `source` of the first step.
run::Simulation after_source(const Parameters& p, const Volume& v, const std::string& name) {
  run::Simulation s(p, v, implementation(name));
  s.begin_step();
  s.run_phase(Phase::source);
  return s;
}

// The grid is 70 x 3 x 4, so a row has two words. Four corners of it, a cell of each side and floor and top
// are tried.
TEST(OpenBorder, TakesTheLiquidOfTheSidesAlone) {
  Volume v(Grid{70, 3, 4});
  put(v, 0, 0, 0, 100, 60, 7);            // a corner: 100 of amount, 60 of energy, 700 of heat
  put(v, 69, 2, 3, 65535, 65535, 65535);  // the opposite one, as full and as hot as can be
  put(v, 0, 1, 2, 1, 0, 3);               // x = 0
  put(v, 69, 0, 1, 20, 5, 1);             // x = nx - 1
  put(v, 64, 1, 0, 4096, 4096, 2);        // z = 0
  put(v, 33, 2, 3, 10, 0, 0);             // z = nz - 1
  put(v, 1, 0, 1, 500, 9, 4);             // stands on the floor, one cell inside
  put(v, 68, 2, 2, 600, 8, 5);            // at the top, one cell inside
  put(v, 64, 1, 1, 700, 7, 6);
  put_solid(v, 0, 0, 1, 4096, 11);  // solids and inert cells stay
  put_inert(v, 69, 0, 2);
  for (const std::string& name : everybody()) {
    const run::Simulation s = after_source(with_open_border(), v, name);
    Volume expected(Grid{70, 3, 4});
    put(expected, 1, 0, 1, 500, 9, 4);
    put(expected, 68, 2, 2, 600, 8, 5);
    put(expected, 64, 1, 1, 700, 7, 6);
    put_solid(expected, 0, 0, 1, 4096, 11);
    put_inert(expected, 69, 0, 2);
    EXPECT_EQ(difference(expected, s.volume()), "") << name;
    EXPECT_EQ(s.ledger().mass.removed, 100 + 65535 + 1 + 20 + 4096 + 10) << name;
    EXPECT_EQ(s.ledger().energy.removed, 60 + 65535 + 0 + 5 + 4096 + 0) << name;
    EXPECT_EQ(s.ledger().heat.removed, state::Sum{700 + 3 + 20 + 8192} + state::Sum{65535} * 65535) << name;
    EXPECT_TRUE(s.drift().none()) << name;
  }
}

TEST(OpenBorder, IsClosedUnlessASceneSaysSo) {
  Volume v(Grid{3, 1, 3});
  put(v, 0, 0, 0, 100);
  for (const std::string& name : everybody())
    EXPECT_EQ(after_source(paper_showcase(), v, name).ledger().mass.removed, 0) << name;
}

// A grid of one or two cells along an axis is all border.
TEST(OpenBorder, OfThinGrids) {
  for (const Grid g : {Grid{1, 5, 9}, {9, 5, 1}, {2, 5, 9}, {9, 5, 2}, {1, 1, 1}, {128, 2, 2}, {3, 2, 3}}) {
    Volume v(g);
    fill(v, whole(g), 10);
    const int inside = g == Grid{3, 2, 3} ? 2 : 0;
    for (const std::string& name : everybody()) {
      const run::Simulation s = after_source(with_open_border(), v, name);
      EXPECT_EQ(s.ledger().mass.removed, 10 * (g.x * g.y * g.z - inside)) << name << ' ' << g.x << ' ' << g.z;
      EXPECT_EQ(s.volume().liquid.count(), inside) << name;
    }
  }
}

// The border comes last. The vent adds 300 to 0, the drain takes 200 of them, and the border the other 100.
TEST(OpenBorder, ComesAfterVentsAndDrains) {
  const rule::Region corner{{8, 8, 8}, 1};
  Parameters p = with_open_border();
  p.vents = {{.region = corner, .rate = 300, .temperature = 50, .energy = 2048}};
  p.drains = {{.region = corner, .rate = 200}};
  for (const std::string& name : everybody()) {
    const run::Simulation s = after_source(p, Volume(Grid{4, 2, 4}), name);
    EXPECT_EQ(s.volume().liquid.count(), 0) << name;
    EXPECT_EQ(s.ledger().mass.added, 300) << name;
    EXPECT_EQ(s.ledger().mass.removed, 300) << name;
    EXPECT_EQ(s.ledger().energy.added, 150) << name;
    EXPECT_EQ(s.ledger().energy.removed, 150) << name;
    EXPECT_EQ(s.ledger().heat.removed, 300 * 50) << name;
  }
}

// A heap in the middle runs away to all sides until nothing is left but what rests.
TEST(OpenBorder, LetsAHeapRunAway) {
  for (const bool open : {false, true}) {
    Parameters p = viscous(1);
    p.open_border = open;
    Volume v(Grid{9, 6, 9});
    fill(v, {3, 0, 3, 6, 5, 6}, kOne);
    run::Simulation s = simulate(p, v);
    steps(s, 400);
    const std::int64_t start = std::int64_t{45} * kOne;
    EXPECT_TRUE(s.drift().none());
    if (open)
      EXPECT_GT(s.ledger().mass.removed, start / 2);
    else
      EXPECT_EQ(s.ledger().mass.removed, 0);
  }
}

}  // namespace
}  // namespace voxmelt::scalar
