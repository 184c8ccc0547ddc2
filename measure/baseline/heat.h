// Heat has conduction (Eq. 1), convection in liquid, radiation and exchange with air. Melting follows.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "measure/baseline/baseline.h"
#include "measure/baseline/rows.h"

namespace voxmelt::baseline {

template <class Real, Variant variant>
void Baseline<Real, variant>::heat(std::span<const Real> irradiance) {
  if (!numbers_.heat) return;
  conduct(irradiance);
  melt();
}

template <class Real, Variant variant>
void Baseline<Real, variant>::conduct(std::span<const Real> irradiance) {
  Fields<Real>& f = fields_;
  const Numbers<Real>& n = numbers_;

  // Eq. 1 takes 6, 18 or 26 neighbours, each with gamma / (pi l^2).
  std::array<std::ptrdiff_t, 26> offsets{};
  std::array<Real, 26> weights{};
  int neighbours = 0;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int distance = dx * dx + dy * dy + dz * dz;
        if (distance == 0 || (distance == 2 && n.neighbours < 18) || (distance == 3 && n.neighbours < 26))
          continue;
        offsets[neighbours] =
            dz * static_cast<std::ptrdiff_t>(f.slice) + dy * static_cast<std::ptrdiff_t>(f.row) + dx;
        weights[neighbours] = distance == 1 ? n.face : distance == 2 ? n.edge : n.corner;
        ++neighbours;
      }

  for (int z = 0; z < f.grid.z; ++z)
    for (int y = 0; y < f.grid.y; ++y) {
      const std::size_t first = f.at(0, y, z), end = first + static_cast<std::size_t>(f.grid.x);
      if (kSkipsRows && !row_has_matter(f, first)) {
        for (std::size_t i = first; i < end; ++i) f.next_temperature[i] = 0;
        continue;
      }
      const Real* light = irradiance.empty() ? nullptr : irradiance.data() + f.grid.index(0, y, z);
      for (std::size_t i = first; i < end; ++i) {
        if (!f.solid[i] && !f.liquid[i]) {
          f.next_temperature[i] = 0;
          continue;
        }
        const Real own = f.temperature[i];
        Real t = own;
        for (int k = 0; k < neighbours; ++k) {
          const std::size_t j = i + offsets[k];
          if (f.solid[j] || f.liquid[j]) t += weights[k] * (f.temperature[j] - own);
        }

        if (n.convection > 0 && f.liquid[i]) {
          const std::size_t below = i - f.row, above = i + f.row;
          if (f.liquid[below] && f.temperature[below] > own) t += n.convection * (f.temperature[below] - own);
          if (f.liquid[above] && own > f.temperature[above]) t -= n.convection * (own - f.temperature[above]);
        }

        if (light && f.solid[i]) t += light[i - first];

        if (n.air) {
          const int exposed = (f.air(i - 1) || f.air(i + 1)) + (f.air(i - f.row) || f.air(i + f.row)) +
                              (f.air(i - f.slice) || f.air(i + f.slice));
          t += n.air_exchange[exposed] * (n.air_temperature[y] - t);
        }
        f.next_temperature[i] = std::min(t, Real{1});
      }
    }
  f.temperature.swap(f.next_temperature);
}

template <class Real, Variant variant>
void Baseline<Real, variant>::melt() {
  Fields<Real>& f = fields_;
  for (int z = 0; z < f.grid.z; ++z)
    for (int y = 0; y < f.grid.y; ++y) {
      const std::size_t first = f.at(0, y, z), end = first + static_cast<std::size_t>(f.grid.x);
      if (kSkipsRows && !row_has_matter(f, first)) continue;
      for (std::size_t i = first; i < end; ++i) {
        if (f.temperature[i] < numbers_.melting_point) continue;
        if (f.solid[i]) {
          f.solid[i] = 0;
          f.liquid[i] = 1;
          f.energy[i] = f.amount[i];
        } else if (f.liquid[i]) {
          f.energy[i] += numbers_.reheat * (f.amount[i] - f.energy[i]);
        }
      }
    }
}

}  // namespace voxmelt::baseline
