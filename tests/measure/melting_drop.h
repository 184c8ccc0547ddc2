// The tests of the baseline share these scenes, and the functions that look at them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "measure/baseline/baseline.h"
#include "tests/kernel/measure.h"

namespace voxmelt::baseline {

// A solid ball lies over a floor with a step in it, in hot moving air and under a lamp, with every rule in
// use.
struct MeltingDrop {
  rule::Parameters parameters;
  state::Volume volume;
  state::Field<std::uint16_t> irradiance;
};

inline MeltingDrop melting_drop() {
  MeltingDrop drop{worlds::paper_showcase(), state::Volume(state::Grid{32, 22, 30}),
                   state::Field<std::uint16_t>(state::Grid{32, 22, 30})};
  rule::Parameters& p = drop.parameters;
  p.flow.fall.wall_factor = 16384;
  p.flow.fall.hang = 512;
  p.flow.paper.reheat = 300;
  p.flow.thermal_viscosity = true;
  for (std::size_t k = 0; k < 32; ++k) p.flow.mobility_table[k] = static_cast<std::uint16_t>(20000 + 900 * k);
  p.heat.enabled = true;
  p.heat.neighbours = 18;
  p.heat.weight_face = 2086;
  p.heat.weight_edge = 1043;
  p.heat.convection = 3000;
  p.heat.air = true;
  p.heat.air_exchange = 1500;
  p.heat.air_temperature.assign(22, rule::Temperature{45000});

  state::Volume& v = drop.volume;
  worlds::fill_inert(v, {0, 0, 0, 32, 2, 30});
  worlds::fill_inert(v, {20, 2, 0, 32, 4, 30});
  worlds::for_each(worlds::whole(v.grid), [&](int x, int y, int z) {
    const double r = std::hypot(x - 15.5, y - 10.0, z - 14.5);
    if (r > 6.5) return;
    worlds::put_solid(v, x, y, z, r < 5.5 ? 4096 : 3000 - 17 * x, 20000 + 100 * y);
    drop.irradiance[v.at(x, y, z)] = y > 13 ? 4000 : 0;
  });
  return drop;
}

template <class Real, Variant variant>
void run_step(Baseline<Real, variant>& baseline, std::uint32_t step, const std::vector<Real>& irradiance) {
  baseline.heat(irradiance);
  baseline.gravity();
  baseline.spread(step);
  baseline.excess();
}

template <class Real>
worlds::Heights heights(const Fields<Real>& f) {
  worlds::Heights result{f.grid.x, f.grid.z,
                         std::vector<double>(static_cast<std::size_t>(f.grid.x * f.grid.z))};
  worlds::for_each(worlds::whole(f.grid), [&](int x, int y, int z) {
    const Cell<Real> cell = f.cell(x, y, z);
    if (cell.liquid) result.h[static_cast<std::size_t>(z * f.grid.x + x)] += static_cast<double>(cell.amount);
  });
  return result;
}

}  // namespace voxmelt::baseline
