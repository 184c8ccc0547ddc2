// Excess (end of section 4.2.2) is liquid of a cell above 1: it climbs as far up its column as it must.
#pragma once

#include <algorithm>
#include <cstddef>

#include "measure/baseline/baseline.h"
#include "measure/baseline/rows.h"

namespace voxmelt::baseline {

template <class Real, Variant variant>
void Baseline<Real, variant>::excess() {
  Fields<Real>& f = fields_;

  for (int z = 0; z < f.grid.z; ++z)
    for (int y = 0; y + 1 < f.grid.y; ++y) {
      const std::size_t first = f.at(0, y, z), end = first + static_cast<std::size_t>(f.grid.x);
      if (kSkipsRows && !row_has(f, f.liquid, first)) continue;
      for (std::size_t i = first; i < end; ++i) {
        const std::size_t above = i + f.row;
        if (!f.liquid[i] || f.amount[i] <= 1 || f.blocked(above)) continue;

        const Real flow = f.amount[i] - 1;
        const Real energy = std::min(f.energy[i], flow);
        if (numbers_.heat)
          f.temperature[above] =
              (f.temperature[above] * f.amount[above] + f.temperature[i] * flow) / (f.amount[above] + flow);
        f.amount[above] += flow;
        f.amount[i] = 1;
        f.energy[above] += energy;
        f.energy[i] -= energy;
        f.liquid[above] = 1;
      }
    }
}

}  // namespace voxmelt::baseline
