// The twin's state has a number per cell and field, and a byte for the kind of each cell. A border of inert
// cells spares the rules a case for the edge.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "kernel/automaton/rule/neighbourhood.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::accuracy::front {

enum Kind : std::uint8_t { kAir = 0, kSolid = 1, kLiquid = 2, kInert = 4, kFresh = 8 };  // fresh: melted now

// Keeps, for each row (y, z), the cells x that may matter: those of matter and of its neighbours.
class Rows {
 public:
  struct Interval {
    int begin = 0, end = 0;
  };
  Rows() = default;
  Rows(state::Grid grid, std::vector<Interval> own) : grid_(grid), rows_(own.size()) {
    for (int z = 0; z < grid.z; ++z)
      for (int y = 0; y < grid.y; ++y) {
        Interval wide{grid.x, 0};
        for (int near_z = std::max(0, z - 1); near_z <= std::min(grid.z - 1, z + 1); ++near_z)
          for (int near_y = std::max(0, y - 1); near_y <= std::min(grid.y - 1, y + 1); ++near_y) {
            const Interval near = own[place(near_y, near_z)];
            if (near.begin >= near.end) continue;
            wide = {std::min(wide.begin, near.begin - 1), std::max(wide.end, near.end + 1)};
          }
        rows_[place(y, z)] = {std::max(0, wide.begin), std::min(grid.x, wide.end)};
      }
  }
  // Gives every row of a slice the union of the slice's rows, for sweeps along gravity.
  Rows columns() const {
    Rows all = *this;
    for (int z = 0; z < grid_.z; ++z) {
      Interval wide{grid_.x, 0};
      for (int y = 0; y < grid_.y; ++y) {
        const Interval row = rows_[place(y, z)];
        if (row.begin < row.end) wide = {std::min(wide.begin, row.begin), std::max(wide.end, row.end)};
      }
      for (int y = 0; y < grid_.y; ++y) all.rows_[place(y, z)] = wide;
    }
    return all;
  }
  template <class Visit>  // visit(x, y, z), x fastest, y ascending
  void for_each(const Visit& visit) const {
    for (int z = 0; z < grid_.z; ++z)
      for (int y = 0; y < grid_.y; ++y) {
        const Interval row = rows_[place(y, z)];
        for (int x = row.begin; x < row.end; ++x) visit(x, y, z);
      }
  }

 private:
  std::size_t place(int y, int z) const { return z * grid_.y + y; }
  state::Grid grid_;
  std::vector<Interval> rows_;
};

template <class Format>
struct Cells {
  using Value = typename Format::Value;
  using Wide = typename Format::Wide;

  explicit Cells(const state::Volume& start)
      : grid(start.grid), line(grid.x + 2), slice(line * (grid.y + 2)), masks(start) {
    const auto count = static_cast<std::size_t>(slice) * (grid.z + 2);
    kind.assign(count, kInert);
    amount.resize(count);
    energy.resize(count);
    heat.resize(count);
    for (int z = 0; z < grid.z; ++z)
      for (int y = 0; y < grid.y; ++y)
        for (int x = 0; x < grid.x; ++x) {
          const std::size_t i = at(x, y, z);
          const state::Slot from = start.at(x, y, z);
          kind[i] = start.solid.test(x, y, z)    ? kSolid
                    : start.inert.test(x, y, z)  ? kInert
                    : start.liquid.test(x, y, z) ? kLiquid
                                                 : kAir;
          amount[i] = static_cast<Value>(Format::of(start.amount[from]));
          energy[i] = static_cast<Value>(std::min(Format::of(start.energy[from]), Wide{amount[i]}));
          heat[i] = static_cast<Value>(Format::of(start.heat[from]));
        }
  }

  std::size_t at(int x, int y, int z) const { return (z + 1) * slice + (y + 1) * line + x + 1; }
  std::ptrdiff_t way(rule::Offset d) const {
    return d.dx + std::ptrdiff_t{line} * d.dy + std::ptrdiff_t{slice} * d.dz;
  }
  static std::size_t moved(std::size_t i, std::ptrdiff_t way) { return i + way; }

  bool blocked(std::size_t i) const { return (kind[i] & (kSolid | kInert)) != 0; }
  bool matter(std::size_t i) const { return (kind[i] & (kSolid | kLiquid)) != 0; }
  bool liquid(std::size_t i) const { return (kind[i] & kLiquid) != 0; }
  bool is_air(std::size_t i) const { return kind[i] == kAir; }

  Rows rows() const {
    std::vector<Rows::Interval> own(static_cast<std::size_t>(grid.y) * grid.z);
    for (int z = 0; z < grid.z; ++z)
      for (int y = 0; y < grid.y; ++y) {
        const std::size_t first = at(0, y, z);
        int begin = 0, end = grid.x;
        while (begin + 8 <= end && none_of_eight(first + begin)) begin += 8;
        while (begin < end && !matter(first + begin)) ++begin;
        while (begin < end && !matter(first + (end - 1))) --end;
        own[z * grid.y + y] = {begin, end};
      }
    return Rows(grid, std::move(own));
  }

  // Brings kinds up to date after amounts changed. A cell that holds something is liquid; one that holds
  // nothing has no energy and no heat.
  void settle(const Rows& where) {
    where.for_each([&](int x, int y, int z) {
      const std::size_t i = at(x, y, z);
      if (blocked(i)) return;
      kind[i] = amount[i] > 0 ? kLiquid : kAir;
      if (kind[i] == kAir) energy[i] = heat[i] = 0;
    });
  }

  state::Grid grid;
  int line, slice;
  std::vector<std::uint8_t> kind;
  std::vector<Value> amount, energy, heat;
  state::Volume masks;  // `solid` and `inert`, for the tracing of rays

 private:
  bool none_of_eight(std::size_t i) const {
    std::uint64_t eight;
    std::memcpy(&eight, &kind[i], sizeof eight);
    return (eight & 0x0303030303030303u) == 0;
  }
};

}  // namespace voxmelt::accuracy::front
