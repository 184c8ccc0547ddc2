// Spreading (Eqs. 7-20) finds every cell's pattern, then lets all cells give, then lets them receive.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "measure/baseline/baseline.h"
#include "measure/baseline/rows.h"

namespace voxmelt::baseline {

// Returns a random number for a cell and a step.
[[gnu::always_inline]] inline std::uint32_t hashed(std::uint32_t cell, std::uint32_t step,
                                                   std::uint32_t seed) {
  std::uint32_t h = (cell + seed) ^ (step * 0x9E3779B9u);
  h = (h ^ (h >> 16)) * 0x7FEB352Du;
  h = (h ^ (h >> 15)) * 0x846CA68Bu;
  return h ^ (h >> 16);
}

// Lists the face neighbours +x, -x, +z, -z, then the diagonals, as distances in the arrays.
template <class Real>
[[gnu::always_inline]] inline std::array<std::ptrdiff_t, 8> horizontal_neighbours(const Fields<Real>& f) {
  const std::ptrdiff_t z = f.slice;
  return {1, -1, z, -z, 1 + z, 1 - z, -1 + z, -1 - z};
}

// Returns the mobility, which is more than 1 if the temperature makes the liquid thin.
template <class Real>
[[gnu::always_inline]] inline Real mobility(const Numbers<Real>& n, Real temperature) {
  if (!n.thermal_viscosity) return 1;
  const auto entry = static_cast<std::size_t>(temperature * 32);
  return std::min(n.mobility[std::min<std::size_t>(entry, 31)], n.mobility_limit);
}

template <class Real, Variant variant>
void Baseline<Real, variant>::spread(std::uint32_t step) {
  find_patterns(step);
  give();
  receive();
}

template <class Real, Variant variant>
void Baseline<Real, variant>::find_patterns(std::uint32_t step) {
  Fields<Real>& f = fields_;
  const Numbers<Real>& n = numbers_;
  const std::array<std::ptrdiff_t, 8> neighbours = horizontal_neighbours(f);

  for (int z = 0; z < f.grid.z; ++z)
    for (int y = 0; y < f.grid.y; ++y) {
      const std::size_t first = f.at(0, y, z), end = first + static_cast<std::size_t>(f.grid.x);
      if (kSkipsRows) {
        f.row_marks[first / f.row] = row_has(f, f.liquid, first);
        if (!f.row_marks[first / f.row]) {
          for (std::size_t i = first; i < end; ++i) f.pattern[i] = 0;
          continue;
        }
      }
      for (std::size_t i = first; i < end; ++i) {
        f.pattern[i] = 0;
        if (!f.liquid[i]) continue;
        if (n.support && f.air(i - f.row)) continue;
        if (f.energy[i] <= n.threshold && n.slump <= 0) continue;

        // A direction is available if it is open and its cell stands lower, by the flow and by a margin.
        const Real margin = f.energy[i] > n.threshold ? n.margin : n.slump;
        const Real flow = f.amount[i] * n.share * mobility(n, f.temperature[i]);
        unsigned available = 0;
        for (int d = 0; d < n.directions; ++d) {
          const std::size_t j = i + neighbours[d];
          if (f.blocked(j)) continue;
          if (d >= 4 && f.blocked(i + (d < 6 ? 1 : -1)) && f.blocked(i + (d % 2 == 0 ? f.slice : -f.slice)))
            continue;
          const Real needed = std::max(flow, d < 4 ? margin : margin * 9 / 8);
          if (n.downhill && f.amount[j] + needed >= f.amount[i]) continue;
          available |= 1u << d;
        }

        // Every subset of them is equally likely.
        if (available == 0) continue;
        f.pattern[i] =
            static_cast<std::uint8_t>(available & hashed(static_cast<std::uint32_t>(i), step, n.seed));
      }
    }
}

template <class Real, Variant variant>
void Baseline<Real, variant>::give() {
  Fields<Real>& f = fields_;
  const Numbers<Real>& n = numbers_;
  const std::array<std::ptrdiff_t, 8> neighbours = horizontal_neighbours(f);

  for (int z = 0; z < f.grid.z; ++z)
    for (int y = 0; y < f.grid.y; ++y) {
      const std::size_t first = f.at(0, y, z), end = first + static_cast<std::size_t>(f.grid.x);
      if (kSkipsRows && !f.row_marks[first / f.row]) continue;
      for (std::size_t i = first; i < end; ++i) {
        if (f.pattern[i] == 0) continue;
        const Real thinner = mobility(n, f.temperature[i]);
        Real amount_out = 0, energy_out = 0;
        for (int d = 0; d < n.directions; ++d) {
          if (!(f.pattern[i] >> d & 1)) continue;
          const std::size_t j = i + neighbours[d];
          const Real part = n.factors[f.pattern[i]][d] * thinner;
          const Real amount = f.amount[i] * part, energy = f.energy[i] * part;
          amount_out += amount;
          energy_out += energy;
          f.amount_gain[j] += amount;
          f.energy_gain[j] += energy;
          if (n.heat) f.heat_gain[j] += amount * f.temperature[i];
        }
        f.amount[i] = std::max(f.amount[i] - amount_out, Real{0});
        f.energy[i] = std::max(f.energy[i] - energy_out, Real{0});
      }
    }
}

template <class Real, Variant variant>
void Baseline<Real, variant>::receive() {
  Fields<Real>& f = fields_;
  const Numbers<Real>& n = numbers_;

  for (int z = 0; z < f.grid.z; ++z)
    for (int y = 0; y < f.grid.y; ++y) {
      const std::size_t first = f.at(0, y, z), end = first + static_cast<std::size_t>(f.grid.x);
      if (kSkipsRows && !marked_near(f, first, false)) continue;
      for (std::size_t i = first; i < end; ++i) {
        if (f.amount_gain[i] > 0) {
          const std::size_t below = i - f.row;
          const Real alpha = f.inert[below] ? n.alpha_floor : f.solid[below] ? n.alpha_solid : n.alpha_liquid;
          const Real before = f.amount[i];
          f.amount[i] += f.amount_gain[i];
          f.energy[i] = std::min(f.energy[i] + alpha * f.energy_gain[i], f.amount[i]);
          if (n.heat) f.temperature[i] = (before * f.temperature[i] + f.heat_gain[i]) / f.amount[i];
          f.liquid[i] = 1;
          f.amount_gain[i] = 0;
          f.energy_gain[i] = 0;
          f.heat_gain[i] = 0;
        } else if (f.pattern[i] != 0) {  // it gave, perhaps all it had
          f.energy[i] = std::min(f.energy[i], f.amount[i]);
          if (f.amount[i] > 0) continue;
          f.liquid[i] = 0;
          f.temperature[i] = 0;
        }
      }
    }
}

}  // namespace voxmelt::baseline
