// A ball of whole cells at one temperature, and what is left of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "accuracy/cells.h"
#include "accuracy/trial.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::accuracy {

// Puts a ball of whole cells in the middle of a cube. With `wall` above 0 inert cells of that temperature are
// around it. Returns the radius of a ball of the same volume.
inline double put_ball(state::Volume& v, double radius, double heat, double wall) {
  double cells = 0;
  for_each_cell(v.grid, [&](int x, int y, int z) {
    const double m = (v.grid.x - 1) / 2.0;
    if (std::hypot(x - m, y - m, z - m) <= radius) {
      put_solid(v, x, y, z, heat);
      ++cells;
    } else if (wall > 0) {
      put_inert(v, x, y, z);
      v.heat[v.at(x, y, z)] = to_units(wall);
    }
  });
  return std::cbrt(0.75 * cells / std::numbers::pi);
}

// Returns what has not melted of a cell, in cells. A solid cell counts by the latent heat that it lacks.
inline double unmelted_of(const Trial& trial, int x, int y, int z) {
  const state::Volume& v = trial.volume();
  const auto& p = trial.simulation().parameters();
  if (!v.solid.test(x, y, z)) return 0;
  const state::Slot cell = v.at(x, y, z);
  const double taken = (v.heat[cell] - 1. * p.material.melting_point) / p.material.latent_heat;
  return v.amount[cell] / kOne * (1 - std::clamp(taken, 0.0, 1.0));
}

inline double unmelted(const Trial& trial) {
  double sum = 0;
  for_each_cell(trial.volume().grid, [&](int x, int y, int z) { sum += unmelted_of(trial, x, y, z); });
  return sum;
}

}  // namespace voxmelt::accuracy
