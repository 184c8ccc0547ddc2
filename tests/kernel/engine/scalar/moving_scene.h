// This scene never rests. A vent pours hot liquid into a cube of 24, a drain at the floor takes it, and an
// oven melts a block slowly.
#pragma once

#include <string>

#include "tests/kernel/worlds.h"

namespace voxmelt::worlds {

inline run::Simulation moving_scene(rule::Law law) {
  Parameters p = law == rule::Law::paper ? paper_showcase() : viscous(0.05, 0.002);
  p.flow.fall.wall_factor = 16384;
  p.flow.fall.hang = 512;
  p.flow.paper.reheat = 200;
  p.heat.enabled = p.heat.air = true;
  p.heat.neighbours = 18;
  p.heat.weight_face = 3000;
  p.heat.weight_edge = 1500;
  p.heat.convection = 1000;
  p.heat.air_exchange = 200;
  p.heat.air_temperature.assign(24, 30000);
  p.material = {33000, 1000};
  p.vents = {{{{16 * 7, 16 * 20, 16 * 7}, 20}, 250, 60000, 4096, 0, 0xFFFFFFFFu}};
  p.drains = {{{{16 * 20, 0, 16 * 20}, 60}, 700, 0, 0xFFFFFFFFu}};
  Volume v(Grid{24, 24, 24});
  for_each({4, 0, 4, 12, 10, 12}, [&](int x, int y, int z) { put_solid(v, x, y, z, kOne, 20000); });
  fill_inert(v, {14, 3, 2, 18, 4, 10});
  for_each({0, 0, 14, 24, 1, 24},
           [&](int x, int y, int z) { put(v, x, y, z, kOne, law == rule::Law::paper ? kOne : 0, 50000); });
  return simulate(p, v);
}

// Runs n steps, and checks that the books balance, the invariants hold, and something still moves at the end.
inline std::string keeps_its_books(run::Simulation& s, int n) {
  for (int i = 0; i < n; ++i) {
    s.step();
    if (i % 1000 != 0 && i != n - 1) continue;
    const state::Drift d = s.drift();
    if (!d.none())
      return "drift at step " + std::to_string(i) + ": mass " + state::to_string(d.mass) + ", energy " +
             state::to_string(d.energy) + ", heat " + state::to_string(d.heat);
    if (const std::string broken = broken_invariant(s.volume(), s.parameters()); !broken.empty())
      return broken;
  }
  const Volume before = s.volume();
  s.step();
  return before.amount == s.volume().amount ? "it rests" : "";
}

}  // namespace voxmelt::worlds
