// Irradiance of a cell from a point source: integer falloff, and the exact walk of its visibility ray.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/heat.h"
#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::rule {

inline constexpr std::int32_t kIrradianceMax = 65535;  // UQ12.4 temperature units per step

// Inverse-square falloff from `power`, no nearer than one cell; `facing_axes` 1..3 open towards the source.
VOXMELT_RULE std::uint64_t irradiance(std::uint64_t power, std::uint64_t distance_squared, int facing_axes) {
  constexpr std::uint64_t one_cell = kPositionUnit * kPositionUnit;
  return power * static_cast<std::uint64_t>(kExposure[static_cast<std::size_t>(facing_axes)]) /
         (4096 * std::max(distance_squared, one_cell));
}

// Walks the cells whose interiors the open segment from a cell's centre to `target` crosses, in order, the
// first one excluded. At an edge or corner it steps along all tied axes at once: touching is not crossing.
class VoxelWalk {
 public:
  VoxelWalk(int x, int y, int z, Position target) : cell_{x, y, z} {
    const std::array<std::int64_t, 3> to{target.x, target.y, target.z};
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int64_t delta = to[a] - (kPositionUnit * cell_[a] + 8);
      step_[a] = delta > 0 ? 1 : -1;
      length_[a] = delta > 0 ? delta : -delta;
      crossing_[a] = 8;
    }
  }

  // Moves to the next cell; false when the segment ends first.
  bool next() {
    // The next crossing on axis a is at parameter crossing / length; compared without division.
    std::size_t first = 3;
    for (std::size_t a = 0; a < 3; ++a) {
      if (crossing_[a] >= length_[a]) continue;
      if (first == 3 || crossing_[a] * length_[first] < crossing_[first] * length_[a]) first = a;
    }
    if (first == 3) return false;
    const std::int64_t at = crossing_[first], of = length_[first];
    for (std::size_t a = 0; a < 3; ++a)
      if (crossing_[a] < length_[a] && crossing_[a] * of == at * length_[a]) {
        cell_[a] += step_[a];
        crossing_[a] += kPositionUnit;
      }
    return true;
  }

  int x() const { return cell_[0]; }
  int y() const { return cell_[1]; }
  int z() const { return cell_[2]; }

 private:
  std::array<int, 3> cell_;
  std::array<int, 3> step_{};
  std::array<std::int64_t, 3> length_{}, crossing_{};
};

}  // namespace voxmelt::rule
