// Cells are read by their coordinates, the border included. The active rows tell where anything can happen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/automaton/rule/heat.h"
#include "kernel/automaton/rule/neighbourhood.h"
#include "kernel/automaton/rule/solid_bed.h"
#include "kernel/automaton/state/ledger.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::scalar {

// The border acts as flat inert solid on all six sides.
class Cells {
 public:
  explicit Cells(const state::Volume& volume) : v_(volume), g_(volume.grid) {}

  bool outside(int x, int y, int z) const { return !g_.contains(x, y, z); }
  bool inert(int x, int y, int z) const { return outside(x, y, z) || v_.inert.test(x, y, z); }
  bool blocked(int x, int y, int z) const {
    return outside(x, y, z) || v_.solid.test(x, y, z) || v_.inert.test(x, y, z);
  }
  bool liquid(int x, int y, int z) const { return !outside(x, y, z) && v_.liquid.test(x, y, z); }
  bool matter(int x, int y, int z) const {
    return !outside(x, y, z) && (v_.solid.test(x, y, z) || v_.liquid.test(x, y, z));
  }
  // Tells if the cell is an inert cell of fixed temperature.
  bool isothermal(int x, int y, int z) const {
    return !outside(x, y, z) && v_.inert.test(x, y, z) && heat(x, y, z) > 0;
  }
  bool air(int x, int y, int z) const { return !blocked(x, y, z) && !v_.liquid.test(x, y, z); }

  // Returns the bed offset of a blocked cell.
  std::int32_t bed(int x, int y, int z, const rule::SolidBeds& solids) const {
    if (outside(x, y, z)) return rule::kBedHalf;
    if (v_.inert.test(x, y, z)) return amount(x, y, z);
    return solids.of(material(x, y, z)).offset(amount(x, y, z), heat(x, y, z));
  }

  state::Slot at(int x, int y, int z) const { return v_.at(x, y, z); }
  std::int32_t amount(int x, int y, int z) const { return v_.amount[at(x, y, z)]; }
  std::int32_t energy(int x, int y, int z) const { return v_.energy[at(x, y, z)]; }
  std::int32_t heat(int x, int y, int z) const { return v_.heat[at(x, y, z)]; }
  int material(int x, int y, int z) const { return v_.material.empty() ? 0 : v_.material[at(x, y, z)]; }

 private:
  const state::Volume& v_;
  state::Grid g_;
};

// Keeps for each row (y, z) the interval of x in which it or one of the eight rows around it holds matter,
// one cell wider on each side. A cell outside the interval has no matter, nor have its neighbours. So no rule
// changes it.
class ActiveRows {
 public:
  explicit ActiveRows(const state::Volume& volume);

  // Returns the intervals for rules that scan along gravity. Every row of a slice z gets the union of its
  // rows.
  static ActiveRows columns(const state::Volume& volume);

  struct Interval {
    int begin, end;
  };
  Interval operator()(int y, int z) const { return intervals_[static_cast<std::size_t>(z) * rows_ + y]; }

  // Calls visit(x, y, z) for every active cell: x fastest, then y ascending, then z.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (int z = 0; z < slices_; ++z)
      for (int y = 0; y < rows_; ++y) {
        const Interval row = (*this)(y, z);
        for (int x = row.begin; x < row.end; ++x) visit(x, y, z);
      }
  }

 private:
  int rows_, slices_;
  std::vector<Interval> intervals_;
};

// Restores the invariants of state::Volume after amounts changed: the liquid mask, and no energy or heat in
// an empty cell.
void settle_masks(const ActiveRows& rows, state::Volume& volume);

// Adds to the number of a cell, where the rules keep the sum within its 16 bits.
inline void add(std::uint16_t& number, std::int32_t change) {
  number = static_cast<std::uint16_t>(number + change);
}

// Returns amount x heat of a part of a cell.
inline std::uint64_t content_of(std::uint64_t amount, std::uint16_t heat) { return amount * heat; }

// Sets the heat of a cell whose contents were mixed (rule::mixed), and books what the rounding changes.
inline void mix(std::uint16_t& heat, std::uint64_t content, std::uint64_t amount, std::int32_t offset,
                state::Ledger& ledger) {
  heat = static_cast<std::uint16_t>(rule::mixed(content, amount, offset));
  const state::Sum before = content, after = content_of(amount, heat);
  ledger.heat.rounded += after - before;
}

// A neighbour is open unless it is blocked, or a diagonal between two blocked cells.
inline bool is_open(const Cells& cells, int x, int y, int z, rule::Direction d) {
  if (cells.blocked(x + d.dx, y, z + d.dz)) return false;
  return d.dx == 0 || d.dz == 0 || !(cells.blocked(x + d.dx, y, z) && cells.blocked(x, y, z + d.dz));
}

// Counts the blocked cells beside an axis pair: those of both cells that lie across the other axis.
inline int blocked_beside(const Cells& cells, int x, int y, int z, rule::Direction to) {
  const auto blocked = [&](int dx, int dz) { return static_cast<int>(cells.blocked(x + dx, y, z + dz)); };
  return blocked(to.dz, to.dx) + blocked(-to.dz, -to.dx) + blocked(to.dx + to.dz, to.dz + to.dx) +
         blocked(to.dx - to.dz, to.dz - to.dx);
}

}  // namespace voxmelt::scalar
