// Makes small volumes and the parameters that they run with, and checks the invariants of every state.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <utility>

#include "kernel/run/simulation.h"

namespace voxmelt::worlds {

using rule::kOne;
using rule::Parameters;
using state::Grid;
using state::Volume;

// Draws the same numbers on every machine (the standard library's distributions do not).
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  std::uint64_t bits() { return engine_(); }
  std::int32_t below(std::int32_t n) {
    return static_cast<std::int32_t>(engine_() % static_cast<std::uint64_t>(n));
  }
  std::int32_t between(std::int32_t first, std::int32_t last) { return first + below(last - first + 1); }
  bool one_in(std::int32_t n) { return below(n) == 0; }
  template <class T>
  T any(std::initializer_list<T> values) {
    return *(values.begin() + below(static_cast<std::int32_t>(values.size())));
  }

 private:
  std::mt19937_64 engine_;
};

inline void put(Volume& v, int x, int y, int z, std::int32_t amount, std::int32_t energy = 0,
                std::int32_t heat = 0) {
  const state::Slot i = v.at(x, y, z);
  v.amount[i] = static_cast<std::uint16_t>(amount);
  v.energy[i] = static_cast<std::uint16_t>(energy);
  v.heat[i] = static_cast<std::uint16_t>(heat);
  v.liquid.set(x, y, z, amount > 0);
}
inline void put_solid(Volume& v, int x, int y, int z, std::int32_t amount = kOne, std::int32_t heat = 0) {
  put(v, x, y, z, amount, 0, heat);
  v.liquid.set(x, y, z, false);
  v.solid.set(x, y, z, true);
}
inline void put_inert(Volume& v, int x, int y, int z, std::int32_t bed = rule::kBedHalf) {
  put(v, x, y, z, bed);
  v.liquid.set(x, y, z, false);
  v.inert.set(x, y, z, true);
}

// Holds the cells begin <= c < end.
struct Box {
  int x0, y0, z0, x1, y1, z1;
};
inline Box whole(Grid g) { return {0, 0, 0, g.x, g.y, g.z}; }
template <class Visit>  // visit(x, y, z), x fastest
void for_each(const Box& b, Visit&& visit) {
  for (int z = b.z0; z < b.z1; ++z)
    for (int y = b.y0; y < b.y1; ++y)
      for (int x = b.x0; x < b.x1; ++x) visit(x, y, z);
}
inline void fill(Volume& v, const Box& b, std::int32_t amount, std::int32_t energy = 0,
                 std::int32_t heat = 0) {
  for_each(b, [&](int x, int y, int z) { put(v, x, y, z, amount, energy, heat); });
}
inline void fill_inert(Volume& v, const Box& b) {
  for_each(b, [&](int x, int y, int z) { put_inert(v, x, y, z); });
}

// The showcase scenes of the paper's law use these parameters.
inline Parameters paper_showcase() {
  Parameters p;
  p.flow.law = rule::Law::paper;
  p.flow.paper.threshold = 1434;  // 0.35
  p.flow.paper.support = true;
  p.flow.paper.slump = 1024;
  p.flow.paper.alpha_liquid = p.flow.paper.alpha_solid = p.flow.paper.alpha_floor = 64225;  // 0.98
  return p;
}

// `kappa` is g dt / nu in cells, and `yield` is in cells^2.
inline Parameters viscous(double kappa, double yield = 0, int stiffness = 8) {
  Parameters p;
  p.flow.law = rule::Law::viscous;
  p.flow.viscous.mobility = static_cast<std::uint64_t>(std::llround(kappa * (2.0 / 9) * 0x1p32));
  p.flow.viscous.yield = static_cast<std::uint32_t>(std::lround(yield * 65536));
  p.flow.viscous.stiffness = static_cast<std::uint8_t>(stiffness);
  return p;
}

inline run::Simulation simulate(Parameters parameters, Volume volume) {
  return {std::move(parameters), std::move(volume), *run::implementations().find("reference")};
}
inline void steps(run::Simulation& simulation, int n) {
  for (int i = 0; i < n; ++i) simulation.step();
}
template <class After>  // after(phase)
void step_by_phase(run::Simulation& simulation, After&& after) {
  simulation.begin_step();
  for (const step::Phase phase : simulation.phases()) {
    simulation.run_phase(phase);
    after(phase);
  }
  simulation.end_step();
}

// Checks the invariants of docs/automaton.md, section 1. Returns nothing if all hold.
inline std::string broken_invariant(const Volume& v, const Parameters& p) {
  std::string broken;
  for_each(whole(v.grid), [&](int x, int y, int z) {
    if (!broken.empty()) return;
    const state::Slot i = v.at(x, y, z);
    const bool solid = v.solid.test(x, y, z), inert = v.inert.test(x, y, z), liquid = v.liquid.test(x, y, z);
    const auto fails = [&](const char* what) {
      broken = std::string(what) + " at " + std::to_string(x) + ", " + std::to_string(y) + ", " +
               std::to_string(z) + ": A " + std::to_string(v.amount[i]) + ", E " +
               std::to_string(v.energy[i]) + ", h " + std::to_string(v.heat[i]);
    };
    if (solid + inert + liquid > 1) fails("two masks");
    if (solid && v.amount[i] == 0) fails("a solid of nothing");
    if (liquid != (!solid && !inert && v.amount[i] > 0)) fails("liquid is not what is defined");
    if (v.energy[i] > v.amount[i]) fails("E > A");
    if (v.energy[i] > 0 && (!liquid || p.flow.law == rule::Law::viscous)) fails("energy where none may be");
    if (v.heat[i] > 0 && !(solid || liquid || (inert && p.heat.walls))) fails("heat where none may be");
    if (v.heat[i] > 0 && v.amount[i] == 0) fails("heat of nothing");
    if (v.heat[i] > 0 && !p.heat.enabled) fails("heat in a scene without it");
  });
  return broken;
}

inline std::int32_t amount_at(const run::Simulation& s, int x, int y, int z) {
  return s.volume().amount[s.volume().at(x, y, z)];
}

}  // namespace voxmelt::worlds
