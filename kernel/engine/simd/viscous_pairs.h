// The pairs of the viscous law (docs/automaton.md, section 11) have masks, drops and conductances. A pair is
// looked at from its first cell: the other is right, front, front right or front left of it. The code is free
// of kernel/automaton/rule on purpose.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/lanes.h"
#include "kernel/engine/simd/kernels.h"

namespace voxmelt::simd {

template <class Arch, bool kRelaxed>
class ViscousPairs {
 protected:
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;
  using Wide = typename L::Wide;

  [[gnu::always_inline]] ViscousPairs(const View& view, const Step& step, const Runs& runs)
      : v_(view), r_(runs), step_(step) {}

  [[gnu::always_inline]] void go_to_slice(int z) {
    z_ = z;
    const auto front = z + 1 < v_.nz ? static_cast<std::ptrdiff_t>(v_.slice) : 0;  // 0: masked
    const std::ptrdiff_t steps[4] = {1, front, front + 1, front - 1};
    for (int axis = 0; axis < 4; ++axis) to_other_[axis] = steps[axis];
    to_back_ = z > 0 ? -static_cast<std::ptrdiff_t>(v_.slice) : 0;  // 0: masked
  }

  struct Masks {
    std::uint64_t in_run, there[4];  // this cell, the other one of a pair
    std::uint64_t pair[4], any;      // open, one of them is in a run, and not both in shut ones
    std::uint64_t beside[2][4];  // blocked cells beside the axis pairs: two of this cell, two of the other
    std::uint64_t corners[2];    // a diagonal's corners, either of them blocked
    bool walls;                  // any cell beside a pair is blocked
    std::uint64_t set, set_there[4];  // cells that are set: this one, the other one of a pair
  };

  // Returns the words of row y whose pairs may have a head that is cut.
  [[gnu::always_inline]] TileRow deep_words(int y) const {
    const TileRow deep = r_.deep[z_ * v_.ny + y] | (z_ + 1 < v_.nz ? r_.deep[(z_ + 1) * v_.ny + y] : 0);
    return deep | deep << 1 | deep >> 1;
  }
  [[gnu::always_inline]] std::uint64_t in_run(int w, int y, int z) const {
    return w < 0 || w >= v_.words || z >= v_.nz ? 0 : r_.in_run[v_.word(w, y, z)];
  }
  [[gnu::always_inline]] std::uint64_t shut(int w, int y, int z) const {
    return w < 0 || w >= v_.words || z >= v_.nz ? 0 : r_.shut[v_.word(w, y, z)];
  }

  [[gnu::always_inline]] bool find_pairs(int w, int y, Masks& m) const {
    const std::uint64_t front_run = in_run(w, y, z_ + 1);
    m.in_run = in_run(w, y, z_);
    m.there[0] = cpu::from_right(m.in_run, in_run(w + 1, y, z_));
    m.there[1] = front_run;
    m.there[2] = cpu::from_right(front_run, in_run(w + 1, y, z_ + 1));
    m.there[3] = cpu::from_left(front_run, in_run(w - 1, y, z_ + 1));
    if ((m.in_run | m.there[0] | m.there[1] | m.there[2] | m.there[3]) == 0) return false;

    const std::uint64_t own = v_.blocked(w, y, z_), front = v_.blocked(w, y, z_ + 1);
    const std::uint64_t right = cpu::from_right(own, v_.blocked(w + 1, y, z_));
    const std::uint64_t left = cpu::from_left(own, v_.blocked(w - 1, y, z_));
    const std::uint64_t front_right = cpu::from_right(front, v_.blocked(w + 1, y, z_ + 1));
    const std::uint64_t front_left = cpu::from_left(front, v_.blocked(w - 1, y, z_ + 1));
    m.pair[0] = ~(own | right);
    m.pair[1] = ~(own | front);
    m.pair[2] = ~(own | front_right | (right & front));
    m.pair[3] = ~(own | front_left | (left & front));
    m.any = 0;
    for (int axis = 0; axis < 4; ++axis) m.pair[axis] &= m.in_run | m.there[axis];
    if (const std::uint64_t own_shut = shut(w, y, z_); own_shut != 0) {
      const std::uint64_t front_shut = shut(w, y, z_ + 1);
      m.pair[0] &= ~(own_shut & cpu::from_right(own_shut, shut(w + 1, y, z_)));
      m.pair[1] &= ~(own_shut & front_shut);
      m.pair[2] &= ~(own_shut & cpu::from_right(front_shut, shut(w + 1, y, z_ + 1)));
      m.pair[3] &= ~(own_shut & cpu::from_left(front_shut, shut(w - 1, y, z_ + 1)));
    }
    find_set(w, y, m);
    for (const std::uint64_t pairs : m.pair) m.any |= pairs;
    if (m.any == 0) return false;

    const std::uint64_t back = v_.blocked(w, y, z_ - 1);
    const std::uint64_t back_right = cpu::from_right(back, v_.blocked(w + 1, y, z_ - 1));
    const std::uint64_t beside[2][4] = {{front, back, front_right, back_right},
                                        {left, right, front_left, front_right}};
    m.walls = false;
    for (int axis = 0; axis < 2; ++axis)
      for (int i = 0; i < 4; ++i) {
        m.beside[axis][i] = beside[axis][i];
        m.walls |= (beside[axis][i] & m.pair[axis]) != 0;
      }
    m.corners[0] = right | front;
    m.corners[1] = left | front;
    return true;
  }

  [[gnu::always_inline]] std::uint64_t set_cells(int w, int y, int z) const {
    return w < 0 || w >= v_.words || z >= v_.nz ? 0 : v_.set[v_.word(w, y, z)];
  }
  [[gnu::always_inline]] void find_set(int w, int y, Masks& m) const {
    m.set = m.set_there[0] = m.set_there[1] = m.set_there[2] = m.set_there[3] = 0;
    if (v_.set == nullptr) return;
    const std::uint64_t front = set_cells(w, y, z_ + 1);
    m.set = set_cells(w, y, z_);
    m.set_there[0] = cpu::from_right(m.set, set_cells(w + 1, y, z_));
    m.set_there[1] = front;
    m.set_there[2] = cpu::from_right(front, set_cells(w + 1, y, z_ + 1));
    m.set_there[3] = cpu::from_left(front, set_cells(w - 1, y, z_ + 1));
  }

  struct Cell {
    V head, amount, dead, mobility, fine, limit, bed;
  };
  [[gnu::always_inline]] Cell load(std::ptrdiff_t at) const {
    return {L::load(r_.head + at), L::load(v_.amount + at), L::load(r_.dead + at), L::load(r_.mobility + at),
            L::load(r_.fine + at), L::load(r_.limit + at),  L::load(r_.bed + at)};
  }

  struct Mobility {  // in 1/65536, and 256ths of that in the upper byte; where heads relax, 2^bits as much
    V coarse, fine;
  };
  struct Conductance {
    V coarse, fine;
  };

  struct Pair {
    V drop, giver, taker;      // giver and taker: amounts
    V along, across, blocked;  // rises of beds; blocked cells beside an axis pair
    M gives;                   // the first cell gives
    std::uint64_t moves;       // lanes that give
    Conductance conductance;
  };

  // Returns whether any of the pairs gives, and what decides how much.
  template <bool kDiagonal>
  [[gnu::always_inline]] bool look(const Cell& own, std::ptrdiff_t at, int axis, int part, const Masks& m,
                                   std::uint64_t among, bool deep, Pair& p) const {
    const std::ptrdiff_t there = at + to_other_[axis];
    const V head = L::load_any(r_.head + there);
    V down = L::sub_saturated(own.head, head), up = L::sub_saturated(head, own.head);
    if (deep) {
      const Wide a = plumbed(own.head, at), b = plumbed(head, there);
      down = L::narrow({a.low - b.low, a.high - b.high});
      up = L::narrow({b.low - a.low, b.high - a.high});
    }
    p.drop = down | up;
    p.gives = L::less(L::zero(), down);
    // A cell outside a run has a dead zone that no drop exceeds, or (air) nothing below it.
    V dead = L::select(p.gives, own.dead, L::load_any(r_.dead + there));
    if constexpr (kDiagonal) dead = L::add_saturated(dead, L::high(dead, L::set(3 << 13)));
    p.moves = L::to_bits(L::less(dead, p.drop)) & (among >> (part * L::kCount));
    keep_set(m, axis, part, p);
    if (p.moves == 0) return false;

    const M here_runs = L::from_bits(m.in_run, part), there_runs = L::from_bits(m.there[axis], part);
    const V amount = L::load_any(v_.amount + there);
    p.giver = L::select(p.gives, own.amount, amount);
    p.taker = L::select(p.gives, amount, own.amount);
    const Mobility both = mobilities(own, there, p.gives, here_runs, there_runs);
    // Between level beds the mean flows. (A giver shows a bed.)
    const V bed = L::load_any(r_.bed + there);
    const V flowing = L::select(L::equal(own.bed, bed), L::mean(own.amount, amount), p.giver);
    p.conductance = conductance(both, flowing);
    p.along = rise(own.bed, bed);
    p.across = rise_across<kDiagonal>(own.bed, bed, at, axis, part, m);
    p.blocked = L::zero();
    if (!kDiagonal && m.walls)
      for (const std::uint64_t blocked : m.beside[axis])
        p.blocked = p.blocked + L::keep(L::from_bits(blocked, part), L::set(1));
    return true;
  }

  // Takes out the lanes whose giver is set.
  [[gnu::always_inline]] static void keep_set(const Masks& m, int axis, int part, Pair& p) {
    if ((m.set | m.set_there[axis]) == 0) return;
    const std::uint64_t gives = L::to_bits(p.gives);
    p.moves &= ~((gives & m.set >> (part * L::kCount)) | (~gives & m.set_there[axis] >> (part * L::kCount)));
  }

  // Tells if all beds are level, or none, and nothing blocked is beside a pair. Else it gives the factor of
  // the slope, in 1/16384.
  template <bool kDiagonal>
  [[gnu::always_inline]] bool level(const Pair& p, M gate, V& factor) const {
    const bool walls = !kDiagonal && L::nonzero(L::keep(gate, p.blocked));
    if (!L::nonzero(L::keep(gate, p.along | p.across)) && !walls) return true;
    V square = L::low(p.along, p.along) + L::low(p.across, p.across);
    if constexpr (kDiagonal) square = L::template shift_right<1>(square);
    const auto whole = typename L::W(1 << 22);
    const V root = L::divide({whole, whole}, L::set(256) + L::min(square, L::set(511))).quotient;
    factor = L::high(root + root, root + root);
    if (walls) factor = factor + L::low(p.blocked, L::template shift_right<3>(factor));
    return false;
  }

  // Returns heads in 32 bits.
  [[gnu::always_inline]] Wide plumbed(V head, std::ptrdiff_t at) const {
    const M cut = L::equal(head, L::set(0xFFFF));
    return L::unpack(L::select(cut, L::load_any(r_.deep_low + at), head),
                     L::keep(cut, L::load_any(r_.deep_high + at)));
  }

  const View v_;
  const Runs r_;
  const Step& step_;
  int z_ = 0;
  std::ptrdiff_t to_other_[4], to_back_ = 0;  // to the other cell of a pair, and to the slice before

 private:
  // Returns how far two beds differ, in 1/16 cell. It is 0 where one of them is none.
  [[gnu::always_inline]] static V rise(V bed, V other) {
    const V between = L::sub_saturated(bed, other) | L::sub_saturated(other, bed);
    return L::select(L::equal(L::min(bed, other), L::zero()), L::zero(), L::min(between, L::set(31)));
  }
  // Walks across the pair, from bed to bed.
  struct Walk {
    V up = L::zero(), down = L::zero();  // the largest rise each way
    [[gnu::always_inline]] void from(V a, V b, std::uint64_t blocked, int part) {
      const M shows = L::less(L::zero(), L::keep(L::from_bits(~blocked, part), L::min(a, b)));
      up = L::max(up, L::keep(shows, L::min(L::sub_saturated(b, a), L::set(31))));
      down = L::max(down, L::keep(shows, L::min(L::sub_saturated(a, b), L::set(31))));
    }
    [[gnu::always_inline]] V across() const {
      return L::sub_saturated(up, down) | L::sub_saturated(down, up);
    }
  };
  // Returns how steep the beds of a pair are across it. At the bottom of a valley they are level.
  template <bool kDiagonal>
  [[gnu::always_inline]] V rise_across(V own, V other, std::ptrdiff_t at, int axis, int part,
                                       const Masks& m) const {
    const auto bed = [&](std::ptrdiff_t to) VOXMELT_LAMBDA { return L::load_any(r_.bed + at + to); };
    const std::ptrdiff_t front = to_other_[1], there = to_other_[axis];
    Walk walk;
    if constexpr (kDiagonal) {
      walk.from(bed(axis == 2 ? 1 : -1), bed(front), m.corners[axis - 2], part);
    } else {
      const std::ptrdiff_t ahead = axis == 0 ? front : -1, behind = axis == 0 ? to_back_ : 1;
      const std::uint64_t* beside = m.beside[axis];
      walk.from(own, bed(ahead), beside[0], part);
      walk.from(bed(behind), own, beside[1], part);
      walk.from(other, bed(there + ahead), beside[2], part);
      walk.from(bed(there + behind), other, beside[3], part);
    }
    return walk.across();
  }

  // Limits a mobility by the depth towards a run, and by 1/8 towards a bare flank.
  [[gnu::always_inline]] Mobility limited(V coarse, V fine, M to_run, V limit) const {
    const V most = L::select(to_run, limit, L::set(kRelaxed ? 8192 >> step_.relaxed_bits : 8192));
    return {L::min(coarse, most), L::keep(L::less(coarse, most), fine)};
  }

  // Returns the mobility of both cells of a pair together.
  [[gnu::always_inline]] Mobility mobilities(const Cell& own, std::ptrdiff_t there, M gives, M here_runs,
                                             M there_runs) const {
    const V limit = L::load_any(r_.limit + there);
    const Mobility a = limited(own.mobility, own.fine, there_runs, own.limit);
    const Mobility b =
        limited(L::load_any(r_.mobility + there), L::load_any(r_.fine + there), here_runs, limit);
    const V all = a.fine + b.fine, carried = L::add_if(L::less(all, a.fine), a.coarse + b.coarse, L::set(1));
    // If the taker is, or stands on, a run, the mobility is at most twice the giver's limit.
    const V giver = L::select(gives, own.limit, limit), taker = L::select(gives, limit, own.limit);
    V most = giver + giver;
    if constexpr (kRelaxed) {
      // Only heads of runs relax. To what stands on a run no more flows than in one sub-step of many.
      V one = L::high(giver, L::set(step_.relaxed_scale));
      if (step_.relaxed_bits > 2) one = L::high(one, L::set(1 << (18 - step_.relaxed_bits)));
      one = L::max(one, L::set(1));
      most = L::select(here_runs, L::select(there_runs, most, one), one);
    }
    most = L::select(L::equal(taker, L::zero()), L::set(0xFFFF), most);
    return {L::min(carried, most), L::keep(L::less(carried, most), all)};
  }

  // Returns (s A) >> 12, at most 2^24 - 1. Where heads relax, more bits count.
  [[gnu::always_inline]] Conductance conductance(const Mobility& s, V amount) const {
    const V fine = L::high(s.fine, amount), low = L::low(s.coarse, amount) + fine;
    const V high = L::add_if(L::less(low, fine), L::high(s.coarse, amount), L::set(1));
    const M over = L::less(L::set(4095), high);
    const V kept = L::set(kRelaxed ? 0xFF00 >> step_.relaxed_bits | 0xFF00 : 0xFF00);
    V rest = L::template shift_left<4>(low);
    if constexpr (kRelaxed) rest = rest | L::template shift_right<12>(L::low(s.fine, amount));
    return {
        L::select(over, L::set(0xFFFF), L::template shift_left<4>(high) | L::template shift_right<12>(low)),
        L::select(over, kept, rest & kept)};
  }
};

}  // namespace voxmelt::simd
