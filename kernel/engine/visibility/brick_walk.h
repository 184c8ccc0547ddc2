// A brick walk is rule::VoxelWalk with one denominator for all three axes, so that it can pass whole bricks
// exactly.
//
// VoxelWalk crosses the next plane of axis a at crossing / length_a. Times the product of the lengths that
// are not 0, that is a whole number. So a comparison needs no product, and a step is an addition.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/changed_bricks.h"
#include "kernel/engine/visibility/caster.h"

namespace voxmelt::visibility {

// Bounds the axes of a ray, in sixteenths, for which 64 bits suffice in any grid. The product of three
// lengths is then at most 2^60. A crossing within a grid of 4096 cells, and 254 bricks beyond, stays below
// 2^17. Multiplied by two lengths it stays below 2^57.
inline constexpr std::int64_t kLongestNarrow = std::int64_t{1} << 20;

// Holds the lengths of a ray along the axes, and the way it goes.
struct Course {
  explicit Course(const Ray& ray) {
    const std::array<std::int64_t, 3> from{ray.start.x, ray.start.y, ray.start.z},
        to{ray.end.x, ray.end.y, ray.end.z};
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int64_t delta = to[a] - from[a], lower = rule::kPositionUnit * ray.cell[a];
      way[a] = delta > 0 ? 1 : -1;
      length[a] = delta > 0 ? delta : -delta;
      crossing[a] = delta > 0 ? lower + rule::kPositionUnit - from[a] : from[a] - lower;
    }
  }
  bool narrow() const { return std::max({length[0], length[1], length[2]}) <= kLongestNarrow; }

  std::array<int, 3> way{};
  std::array<std::int64_t, 3> length{}, crossing{};
};

template <class Whole>  // std::int64_t, or a wider type
class BrickWalk {
 public:
  BrickWalk(const Cell& cell, const Course& course) : cell_(cell), way_(course.way) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (course.length[a] == 0) {
        next_[a] = kNever;
        continue;
      }
      end_ *= course.length[a];
      Whole others = 1;
      for (const std::size_t b : {(a + 1) % 3, (a + 2) % 3})
        if (course.length[b] > 0) others *= course.length[b];
      next_[a] = course.crossing[a] * others;
      each_[a] = rule::kPositionUnit * others;
    }
  }

  const Cell& cell() const { return cell_; }

  // Moves to the next cell. It returns false when the segment ends first.
  bool step() {
    const Whole at = std::min({next_[0], next_[1], next_[2]});
    if (at >= end_) return false;
    for (std::size_t a = 0; a < 3; ++a) {
      const bool crosses = next_[a] == at;
      cell_[a] += crosses ? way_[a] : 0;
      next_[a] += crosses ? each_[a] : 0;
    }
    return true;
  }

  // Tests cells until one holds, the segment ends, or the walk has left the brick. It returns which of these
  // happened. Cells are numbers within a brick, as Opaque::place counts them.
  enum class End { stopped, arrived, left };
  template <class Test>
  End within(std::uint32_t& number, const Test& test) {
    // Each coordinate has five bits: 8 to 15 inside the brick, 7 or 16 beyond.
    constexpr std::uint32_t kGuards = 0x6318, kInside = 0x2108;
    const Cell first{cell_[0] & ~7, cell_[1] & ~7, cell_[2] & ~7};
    std::uint32_t packed = kInside;
    std::array<std::uint32_t, 3> moves{};
    for (std::size_t a = 0; a < 3; ++a) {
      const std::uint32_t inside = cell_[a] & 7, way = way_[a];
      packed += inside << (5 * a);
      moves[a] = way << (5 * a);
    }
    End end = End::left;
    do {
      number = (packed & 7) | (packed >> 2 & 0x38) | (packed >> 4 & 0x1c0);
      const Whole at = std::min({next_[0], next_[1], next_[2]});
      if (test(number)) {
        end = End::stopped;
      } else if (at >= end_) {
        end = End::arrived;
      } else {
        for (std::size_t a = 0; a < 3; ++a) {
          const bool crosses = next_[a] == at;
          packed += crosses ? moves[a] : 0;
          next_[a] += crosses ? each_[a] : 0;
        }
        continue;
      }
      break;
    } while ((packed & kGuards) == kInside);
    for (std::size_t a = 0; a < 3; ++a) cell_[a] = first[a] + (packed >> (5 * a) & 31) - state::kBrickSide;
    return end;
  }

  // Returns a bit for each axis along which the ray goes up.
  std::size_t octant() const { return (way_[0] > 0) | (way_[1] > 0) << 1 | (way_[2] > 0) << 2; }

  // Moves to the first cell beyond the cube of `side` bricks that begins with this one, on the way. It
  // returns false when the segment ends first.
  bool leave(int side) {
    const int more = state::kBrickSide * (side - 1);
    Whole exit = kNever;
    for (std::size_t a = 0; a < 3; ++a) exit = std::min(exit, next_[a] + (more + inside(a)) * each_[a]);
    if (exit >= end_) return false;
    for (std::size_t a = 0; a < 3; ++a) {
      const Whole rest = exit - next_[a];
      if (rest >= 0) cross(a, 1 + (side == 1 ? eighths(rest, each_[a]) : static_cast<int>(rest / each_[a])));
    }
    return true;
  }

  // Moves to the first cell of the walk in the brick that begins at `first`. It returns false when it has
  // none there.
  bool enter(const Cell& first) {
    Whole entry = -1;
    for (std::size_t a = 0; a < 3; ++a) {
      const int last = first[a] + state::kBrickSide - 1;
      const int planes = way_[a] > 0 ? first[a] - cell_[a] : cell_[a] - last;
      if ((way_[a] > 0 ? last - cell_[a] : cell_[a] - first[a]) < 0) return false;  // the brick lies behind
      if (planes <= 0) continue;
      if (each_[a] == 0) return false;
      entry = std::max(entry, next_[a] + (planes - 1) * each_[a]);
    }
    if (entry >= end_) return false;
    for (std::size_t a = 0; a < 3; ++a) {
      const Whole rest = entry - next_[a];
      if (rest >= 0) cross(a, 1 + static_cast<int>(rest / each_[a]));
    }
    return same_brick(first);
  }

  bool same_brick(const Cell& other) const {
    return ((cell_[0] ^ other[0]) | (cell_[1] ^ other[1]) | (cell_[2] ^ other[2])) >> 3 == 0;
  }

 private:
  static constexpr Whole kNever = Whole{1} << (8 * sizeof(Whole) - 2);

  // Returns how many more cells of the brick lie ahead.
  int inside(std::size_t a) const { return way_[a] > 0 ? 7 - (cell_[a] & 7) : cell_[a] & 7; }
  void cross(std::size_t a, int planes) {
    cell_[a] += planes * way_[a];
    next_[a] += planes * each_[a];
  }
  static int eighths(Whole rest, Whole each) {
    int quotient = 0;
    for (const int k : {4, 2, 1}) {
      const bool fits = rest >= k * each;
      quotient += fits ? k : 0;
      rest -= fits ? k * each : 0;
    }
    return quotient;
  }

  Cell cell_;
  std::array<int, 3> way_;
  std::array<Whole, 3> next_{}, each_{};  // to the next plane, and from plane to plane; 0: no plane is met
  Whole end_ = 1;
};

// Calls `walk` with the walk of a ray, in numbers that are wide enough.
template <class Walk>
auto with_walk(const Ray& ray, const Walk& walk) {
  __extension__ using Wide = __int128;
  const Course course(ray);
  if (course.narrow()) {
    BrickWalk<std::int64_t> narrow(ray.cell, course);
    return walk(narrow);
  }
  BrickWalk<Wide> wide(ray.cell, course);
  return walk(wide);
}

// Returns the opaque cell that the walk meets before it leaves its brick, or kSees. `ends` tells if the
// segment ends in the brick.
template <class Walk>
Fate meet_in_brick(const Opaque& opaque, std::size_t brick, Walk& walk, bool& ends) {
  const std::uint8_t* const rows = opaque.rows(brick);
  std::uint32_t number = 0;
  const auto end =
      walk.within(number, [&](std::uint32_t at) { return (rows[at >> 3] >> (at & 7) & 1) != 0; });
  using End = typename Walk::End;
  ends = end == End::arrived;
  return end == End::stopped ? met(brick << 9 | number) : kSees;
}

}  // namespace voxmelt::visibility
