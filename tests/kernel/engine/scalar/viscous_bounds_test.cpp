// States that few scenes have, and that some rules of the viscous law are for: liquid that falls past a run,
// moulds that are nearly full, columns far over-full, cliffs with one sub-step.
#include <gtest/gtest.h>

#include "tests/kernel/measure.h"

namespace voxmelt::scalar {
namespace {

using namespace worlds;
using step::Phase;

Parameters relaxed(double kappa) {
  Parameters p = viscous(kappa);
  p.flow.viscous.substeps = 0;
  p.flow.viscous.substeps_max = 1;
  p.flow.viscous.stages_max = 16;
  return p;
}

// Makes a ball of liquid in a mould. Its columns hold up to `missing` less or more than they have room for.
Volume vault(int missing) {
  Volume v(Grid{12, 12, 12});
  Random random(3);
  for_each({0, 0, 0, 12, 12, 12}, [&](int x, int y, int z) {
    const auto inside = [&](int at) {
      const double dx = x - 5.5, dy = at - 5.5, dz = z - 5.5;
      return dx * dx + dy * dy + dz * dz < 25;
    };
    if (!inside(y))
      fill_inert(v, {x, y, z, x + 1, y + 1, z + 1});
    else
      put(v, x, y, z, kOne + (inside(y + 1) ? 0 : random.between(-missing, missing)));
  });
  return v;
}

// A mould in which something has melted is never full to the unit.
TEST(Vault, WhatNearlyFillsItStaysInIt) {
  const Volume v = vault(60);
  run::Simulation s = simulate(viscous(0.2), v);
  steps(s, 20);
  EXPECT_EQ(s.volume().amount, v.amount);
}

TEST(Vault, WhatFillsItStaysInItWithRelaxedHeads) {
  const Volume v = vault(0);
  run::Simulation s = simulate(relaxed(5), v);
  steps(s, 20);
  EXPECT_GT(s.moment().stages, 1) << "heads relax";
  EXPECT_EQ(s.volume().amount, v.amount);
}

// A drop falls onto a pool that is higher here than there. Only what stands in runs flows sideways.
TEST(Fall, ADropGoesStraightDownOntoARun) {
  Volume v(Grid{6, 12, 3});
  fill(v, {0, 0, 0, 6, 3, 3}, kOne);
  for_each({0, 3, 0, 6, 4, 3}, [&](int x, int y, int z) { put(v, x, y, z, x < 3 ? 1000 : 200); });
  put(v, 2, 4, 1, 1200);
  run::Simulation s = simulate(viscous(2), v);
  step_by_phase(s, [&](Phase) {
    for_each({0, 4, 0, 6, 5, 3}, [&](int x, int y, int z) {
      const bool is_the_drop = x == 2 && z == 1;
      EXPECT_TRUE(is_the_drop || s.volume().amount[v.at(x, y, z)] == 0) << x << " " << z;
    });
  });
  EXPECT_EQ(s.volume().amount[v.at(2, 4, 1)], 0) << "it has fallen";
}

// Twenty cells of twice the matter settle into forty. No cell may hold more than its 16 bits on the way, so
// no heat is lost.
TEST(Settle, AColumnFarOverFullKeepsItsHeat) {
  Parameters p = viscous(0.02);
  p.heat.enabled = true;
  p.material.melting_point = 65535;
  Volume v(Grid{1, 60, 1});
  for (int y = 0; y < 20; ++y) put(v, 0, y, 0, 2 * kOne, 0, 10000 + 2000 * y);
  run::Simulation s = simulate(p, v);
  const state::Sum mass = state::holdings(v).liquid, heat = state::holdings(v).heat;
  steps(s, 3);
  EXPECT_EQ(state::holdings(s.volume()).liquid, mass);
  EXPECT_EQ(state::holdings(s.volume()).heat - heat, s.ledger().heat.rounded);
  for (int y = 0; y < 40; ++y) {
    const int h = s.volume().heat[v.at(0, y, 0)];
    EXPECT_TRUE(10000 <= h && h <= 48000) << y << " " << h;
  }
}

// Deep columns stand beside shallow ones. One sub-step must not throw more over than levels them.
TEST(Pool, ACheckerboardOfDepthsGoesFlatWithOneSubstep) {
  Volume v(Grid{16, 12, 16});
  for_each({0, 0, 0, 16, 9, 16}, [&](int x, int y, int z) {
    if (y < ((x + z) % 2 ? 9 : 1)) put(v, x, y, z, kOne);
  });
  run::Simulation s = simulate(viscous(100), v);
  double before = roughness(heights(s.volume()));
  const double first = before;
  for (int i = 0; i < 40; ++i) {
    s.step();
    const double now = roughness(heights(s.volume()));
    EXPECT_LE(now, before + 0.01) << i;
    before = now;
  }
  EXPECT_LT(before, first / 10);
}

// The same layers in the other order have the same mean heat, and flow alike in the first step.
TEST(Film, FlowsByTheMeanHeatOfItsLayers) {
  const auto given = [](int lower, int upper) {
    Parameters p = viscous(0.02);
    p.heat.enabled = true;
    p.material.melting_point = 65535;
    p.flow.thermal_viscosity = true;
    p.flow.mobility_reference = 20000;
    p.flow.mobility_rate = 640;  // 10 octaves over the range
    Volume v(Grid{9, 4, 9});
    for_each({3, 0, 3, 6, 2, 6},
             [&](int x, int y, int z) { put(v, x, y, z, kOne, 0, y == 0 ? lower : upper); });
    run::Simulation s = simulate(p, v);
    s.step();
    return heights(s.volume())(2, 4);
  };
  EXPECT_GT(given(10000, 30000), 0);
  EXPECT_EQ(given(10000, 30000), given(30000, 10000));
}

}  // namespace
}  // namespace voxmelt::scalar
