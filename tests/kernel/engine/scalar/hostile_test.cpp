// For anything that a scene may hold, the invariants hold and the books balance after every phase, and only
// cells near matter change. The grids have 1, 2, 63, 64 and 65 cells along each axis in turn.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kernel/automaton/state/difference.h"
#include "kernel/engine/scalar/cells.h"
#include "tests/kernel/engine/scalar/hostile.h"

namespace voxmelt::scalar {
namespace {

using namespace worlds;
using step::Phase;

constexpr int kCases = 120, kSteps = 8;

struct Shape {
  rule::Law law;
  Grid grid;
};

class Hostile : public testing::TestWithParam<Shape> {};

// Marks the cells that a phase may change: those that can touch matter within one cell. If the phase scans
// along gravity, they are whole columns. It is written from the definition, cell by cell.
std::vector<bool> near_matter(const Volume& v, bool columns) {
  const Grid g = v.grid;
  std::vector<bool> near(g.cells());
  for_each(whole(g), [&](int x, int y, int z) {
    if (!v.solid.test(x, y, z) && !v.liquid.test(x, y, z)) return;
    for_each({std::max(0, x - 1), columns ? 0 : std::max(0, y - 1), std::max(0, z - 1), std::min(g.x, x + 2),
              columns ? g.y : std::min(g.y, y + 2), std::min(g.z, z + 2)},
             [&](int nx, int ny, int nz) { near[g.index(nx, ny, nz)] = true; });
  });
  return near;
}

void expect_only_near_changed(const Volume& before, const Volume& after, Phase phase) {
  const bool columns = phase == Phase::gravity || phase == Phase::excess;
  const std::vector<bool> near = near_matter(before, columns);
  const ActiveRows rows = columns ? ActiveRows::columns(before) : ActiveRows(before);
  for_each(whole(before.grid), [&](int x, int y, int z) {
    const bool active = rows(y, z).begin <= x && x < rows(y, z).end;
    ASSERT_TRUE(active || !near[before.grid.index(x, y, z)])
        << "ActiveRows misses " << x << ' ' << y << ' ' << z;
    if (active && near[before.grid.index(x, y, z)]) return;
    ASSERT_TRUE(state::same_cell(before, after, x, y, z))
        << "changed far from matter: " << x << ' ' << y << ' ' << z;
  });
}

void expect_blocked_kept(const Parameters& p, const Volume& before, const Volume& after, Phase phase) {
  ASSERT_TRUE(before.inert == after.inert);
  if (phase != Phase::melt) {
    ASSERT_TRUE(before.solid == after.solid);
  }
  for_each(whole(before.grid), [&](int x, int y, int z) {
    const state::Slot i = before.at(x, y, z);
    if (before.inert.test(x, y, z) || before.solid.test(x, y, z)) {
      ASSERT_EQ(before.amount[i], after.amount[i]);
    }
    if (before.solid.test(x, y, z) || !after.solid.test(x, y, z)) return;
    ASSERT_EQ(phase, Phase::melt) << "a cell became solid";
    ASSERT_TRUE(before.liquid.test(x, y, z));
    ASSERT_LT(before.heat[i], p.material.freezing_point);
    ASSERT_GE(before.amount[i], 4032);
    ASSERT_EQ(after.amount[i], before.amount[i]);
    ASSERT_EQ(after.heat[i], before.heat[i]);
    ASSERT_EQ(after.energy[i], 0);
  });
}

// Returns what is set after melt: liquid below the freezing point that did not freeze.
std::vector<state::Slot> cold_liquid(const Volume& v, const Parameters& p) {
  std::vector<state::Slot> cold;
  if (!p.freezes()) return cold;
  for_each(whole(v.grid), [&](int x, int y, int z) {
    const state::Slot i = v.at(x, y, z);
    if (v.liquid.test(x, y, z) && v.heat[i] < p.material.freezing_point) cold.push_back(i);
  });
  return cold;
}

void expect_nothing_given(const std::vector<state::Slot>& cold, const Volume& before, const Volume& after) {
  for (const state::Slot i : cold) {
    ASSERT_GE(after.amount[i], before.amount[i]) << "a set cell gave";
  }
}

TEST_P(Hostile, EveryPhaseKeepsEveryPromise) {
  const auto [law, grid] = GetParam();
  const int cases = grid.cells() > 500 ? kCases / 4 : kCases;
  for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(cases); ++seed) {
    Random random(seed * 977 + grid.cells());
    Parameters p = hostile_parameters(random, law, grid);
    may_freeze(random, p);
    if (random.one_in(3)) p.flow.viscous.stages_max = random.any<std::uint16_t>({2, 3, 5, 16});
    Volume start = hostile_volume(random, p, grid);
    may_be_of_materials(random, p, start);
    run::Simulation s = simulate(p, start);
    ASSERT_EQ(broken_invariant(s.volume(), p), "") << "the start, seed " << seed;
    for (int i = 0; i < kSteps; ++i) {
      Volume before = s.volume();
      state::Ledger books = s.ledger();
      std::vector<state::Slot> cold;
      step_by_phase(s, [&](Phase phase) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(i) + ", after " +
                     std::string(step::kPhaseNames[static_cast<std::size_t>(phase)]));
        const Volume& v = s.volume();
        ASSERT_EQ(broken_invariant(v, p), "");
        const state::Drift d = s.drift();
        ASSERT_TRUE(d.none()) << "drift of mass " << state::to_string(d.mass) << ", energy "
                              << state::to_string(d.energy) << ", heat " << state::to_string(d.heat);
        if (phase != Phase::source) {
          ASSERT_EQ(s.ledger().mass.expected(), books.mass.expected())
              << "mass comes and goes by sources only";
          expect_only_near_changed(before, v, phase);
        }
        expect_blocked_kept(p, before, v, phase);
        if (phase == Phase::melt) cold = cold_liquid(v, p);
        if (phase == Phase::spread) expect_nothing_given(cold, before, v);
        before = v;
        books = s.ledger();
      });
      ASSERT_FALSE(HasFatalFailure());
    }
  }
}

std::vector<Shape> shapes() {
  std::vector<Shape> all;
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
    for (const int n : {1, 2, 63, 64, 65}) {
      all.push_back({law, {n, 5, 3}});
      all.push_back({law, {4, n, 3}});
      all.push_back({law, {3, 5, n}});
    }
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    all.push_back({law, {1, 1, 1}});
    all.push_back({law, {9, 8, 10}});
  }
  return all;
}
INSTANTIATE_TEST_SUITE_P(Grids, Hostile, testing::ValuesIn(shapes()), [](const auto& shape) {
  const Grid g = shape.param.grid;
  return std::string(shape.param.law == rule::Law::paper ? "paper_" : "viscous_") + std::to_string(g.x) +
         "x" + std::to_string(g.y) + "x" + std::to_string(g.z);
});

}  // namespace
}  // namespace voxmelt::scalar
