// The irradiance of a cell from a point source depends on its faces and on the exact walk of their rays.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::rule {

inline constexpr std::int32_t kIrradianceMax = 65535;  // UQ12.4 temperature units per step

// Returns floor(sqrt(a)), digit by digit. It is exact, and the same everywhere.
VOXMELT_RULE std::uint64_t square_root(std::uint64_t a) {
  std::uint64_t root = 0;
  const int even = (63 - std::countl_zero(a | 1)) & ~1;  // log2 of the greatest power of 4 <= a
  for (std::uint64_t bit = std::uint64_t{1} << even; bit != 0; bit >>= 2) {
    const std::uint64_t next = root + bit;
    root >>= 1;
    if (a < next) continue;
    a -= next;
    root += bit;
  }
  return root;
}

// Returns the irradiance of a cell that takes in all of `sum`, but has only this amount of matter to warm. A
// solid has some; a volume edited by hand may break that, and nothing divides by 0.
VOXMELT_RULE std::uint16_t irradiance_of_amount(std::uint32_t sum, std::uint32_t amount) {
  return static_cast<std::uint16_t>(
      std::min<std::uint32_t>(kIrradianceMax, kOne * sum / std::max(amount, 1u)));
}

// Returns the irradiance that the faces of a cell receive from a source: power x sum / |delta|^3. The sum
// takes |delta| along its axis for each face. So it is the inverse square times the cosine of each face, no
// nearer than one cell.
//   facing            that sum, taken for every ray that sees the source
//   rays              rays of a face: 1, 4 or 16
//   distance_squared  |delta|^2 from the cell's centre, below 2^52
VOXMELT_RULE std::uint64_t irradiance(std::uint64_t power, std::int64_t facing, int rays,
                                      std::uint64_t distance_squared) {
  __extension__ using Wide = unsigned __int128;
  constexpr std::uint64_t one_cell = kPositionUnit * kPositionUnit;
  const std::uint64_t squared = std::max(distance_squared, one_cell);
  const std::uint64_t length = square_root(squared << 12);  // in 1/64 of a position's unit
  return static_cast<std::uint64_t>(Wide{power} * (std::uint64_t{64} * facing) /
                                    (Wide{squared} * length * static_cast<unsigned>(rays)));
}

// Walks the cells whose interiors the open segment from `start` to `target` crosses, in order. At an edge or
// a corner it steps along all tied axes at once, because touching is not crossing.
class VoxelWalk {
 public:
  // Starts in `cell`, the first one that is crossed. `start` lies inside it, or on its border and behind it.
  VoxelWalk(std::array<int, 3> cell, Position start, Position target) : cell_(cell) {
    const std::array<std::int64_t, 3> from{start.x, start.y, start.z}, to{target.x, target.y, target.z};
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int64_t delta = to[a] - from[a], lower = kPositionUnit * cell_[a];
      step_[a] = delta > 0 ? 1 : -1;
      length_[a] = delta > 0 ? delta : -delta;
      crossing_[a] = delta > 0 ? lower + kPositionUnit - from[a] : from[a] - lower;
    }
  }

  // Moves to the next cell. It returns false when the segment ends first.
  bool next() {
    // The next crossing on axis a is at parameter crossing / length. Parameters are compared without
    // division.
    std::size_t first = 3;
    for (std::size_t a = 0; a < 3; ++a) {
      if (crossing_[a] >= length_[a]) continue;
      if (first == 3 || crossing_[a] * length_[first] < crossing_[first] * length_[a]) first = a;
    }
    if (first == 3) return false;
    const std::int64_t at = crossing_[first], length = length_[first];
    for (std::size_t a = 0; a < 3; ++a)
      if (crossing_[a] < length_[a] && crossing_[a] * length == at * length_[a]) {
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
