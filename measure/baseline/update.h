// The picture (section 5) turns amounts into intensities 0..255, smoothed by a 3 x 3 x 3 low-pass filter.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "measure/baseline/baseline.h"
#include "measure/baseline/rows.h"

namespace voxmelt::baseline {

template <class Real, Variant variant>
void Baseline<Real, variant>::update() {
  Fields<Real>& f = fields_;

  for (int z = 0; z < f.grid.z; ++z)
    for (int y = 0; y < f.grid.y; ++y) {
      const std::size_t first = f.at(0, y, z), end = first + static_cast<std::size_t>(f.grid.x);
      if (kSkipsRows) {
        f.row_marks[first / f.row] = row_has_matter(f, first);
        if (!f.row_marks[first / f.row]) {
          for (std::size_t i = first; i < end; ++i) f.intensity[i] = 0;
          continue;
        }
      }
      for (std::size_t i = first; i < end; ++i)
        f.intensity[i] = static_cast<std::uint8_t>(std::min(f.amount[i], Real{1}) * 255 + Real{0.5});
    }

  // The kernel is binomial: 8 in the middle, 4 at faces, 2 at edges, 1 at corners; 64 in all.
  std::array<std::ptrdiff_t, 27> offsets{};
  std::array<int, 27> weights{};
  int taps = 0;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx, ++taps) {
        offsets[taps] =
            dz * static_cast<std::ptrdiff_t>(f.slice) + dy * static_cast<std::ptrdiff_t>(f.row) + dx;
        weights[taps] = (2 - dx * dx) * (2 - dy * dy) * (2 - dz * dz);
      }

  for (int z = 0; z < f.grid.z; ++z)
    for (int y = 0; y < f.grid.y; ++y) {
      const std::size_t first = f.at(0, y, z), end = first + static_cast<std::size_t>(f.grid.x);
      if (kSkipsRows && !marked_near(f, first, true)) {
        for (std::size_t i = first; i < end; ++i) f.filtered[i] = 0;
        continue;
      }
      for (std::size_t i = first; i < end; ++i) {
        int sum = 32;
        for (int k = 0; k < 27; ++k) sum += weights[k] * f.intensity[i + offsets[k]];
        f.filtered[i] = static_cast<std::uint8_t>(sum / 64);
      }
    }
}

}  // namespace voxmelt::baseline
