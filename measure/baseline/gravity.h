// Gravity (Eqs. 2-6) takes every column from its bottom up, so that liquid in free air falls whole, a cell
// per step.
#pragma once

#include <algorithm>
#include <cstddef>

#include "measure/baseline/baseline.h"
#include "measure/baseline/rows.h"

namespace voxmelt::baseline {

template <class Real, Variant variant>
void Baseline<Real, variant>::gravity() {
  Fields<Real>& f = fields_;
  const Numbers<Real>& n = numbers_;

  for (int z = 0; z < f.grid.z; ++z)
    for (int y = 1; y < f.grid.y; ++y) {
      const std::size_t first = f.at(0, y, z), end = first + static_cast<std::size_t>(f.grid.x);
      if (kSkipsRows && !row_has(f, f.liquid, first)) continue;
      for (std::size_t i = first; i < end; ++i) {
        const std::size_t below = i - f.row;
        if (!f.liquid[i] || f.blocked(below) || f.amount[below] >= 1) continue;

        // A film that hangs from something waits until it is a drop.
        const bool wall =
            f.blocked(i - 1) || f.blocked(i + 1) || f.blocked(i - f.slice) || f.blocked(i + f.slice);
        if (f.amount[i] < n.hang && f.amount[below] == 0 && (wall || f.blocked(i + f.row))) continue;

        const Real ready = std::min(f.amount[i], f.amount[i] * (wall ? n.wall_factor : n.factor) + n.minimum);
        const Real flow = std::min(ready, 1 - f.amount[below]);
        const Real energy = std::min(f.energy[i], flow);

        if (n.heat)
          f.temperature[below] =
              (f.temperature[below] * f.amount[below] + f.temperature[i] * flow) / (f.amount[below] + flow);
        f.amount[below] += flow;
        f.amount[i] -= flow;
        f.energy[below] = std::min(f.energy[below] + n.beta * energy, f.amount[below]);
        f.energy[i] = std::min(f.energy[i] - energy, f.amount[i]);
        f.liquid[below] = 1;
        if (f.amount[i] <= 0) {
          f.liquid[i] = 0;
          f.energy[i] = 0;
          f.temperature[i] = 0;
        }
      }
    }
}

}  // namespace voxmelt::baseline
