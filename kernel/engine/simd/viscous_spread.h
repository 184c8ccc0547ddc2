// The first half of phase `spread` of the viscous law (docs/automaton.md, section 11) computes what each pair
// of neighbours exchanges. A pair is computed once, at its first cell: the other is right, front, front right
// or front left of it. The code goes row by row through one slice, 64 cells at a time. It is free of
// kernel/automaton/rule on purpose.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/lanes.h"
#include "kernel/engine/simd/features.h"
#include "kernel/engine/simd/kernels.h"

namespace voxmelt::simd {

// Less flows on a slope. The factors go by 16 times the difference of two beds in cells, and 1 is 16384.
struct SlopeFactors {
  alignas(64) std::uint16_t axis[32] = {16384, 16257, 15888, 15308, 14564, 13707, 12788, 11848, 10923,
                                        10034, 9198,  8422,  7710,  7061,  6473,  5941,  5461};
  alignas(64) std::uint16_t diagonal[32] = {16384, 16256, 15876, 15254, 14407, 13365, 12168, 10864, 9511,
                                            8165,  6880,  5696,  4641,  3730,  2962,  2331,  1820};
};
inline constexpr SlopeFactors kSlope;

template <class Arch, ViscousFeatures kFeatures>
class ExchangePairs {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;
  using Wide = typename L::Wide;

 public:
  [[gnu::always_inline]] ExchangePairs(const View& view, const Step& step, int z, const Runs& runs,
                                       Currents& currents)
      : v_(view),
        r_(runs),
        step_(step),
        z_(z),
        c_(currents),
        slope_{L::table(kSlope.axis), L::table(kSlope.diagonal)} {
    const auto front = z + 1 < view.nz ? static_cast<std::ptrdiff_t>(view.slice) : 0;  // 0: masked
    const std::ptrdiff_t steps[4] = {1, front, front + 1, front - 1};
    for (int axis = 0; axis < 4; ++axis) to_other_[axis] = steps[axis];
  }

  // Computes row y. It returns the restless words.
  [[gnu::always_inline]] TileRow row(int y, TileRow work) {
    if ((work | c_.giving[y]) == 0) return 0;
    TileRow restless = 0, giving = 0;
    if (v_.words < 64) work &= (TileRow{1} << v_.words) - 1;
    TileRow deep = deep_words(y, z_) | deep_words(y, z_ + 1);
    deep |= deep << 1 | deep >> 1;
    for (; work != 0; work &= work - 1) {
      const int w = __builtin_ctzll(work);
      const TileRow bit = work & -work;
      Masks masks;
      if (!find_pairs(w, y, masks)) continue;
      if (dithered_ != y) set_dither(y);
      bool flows = false, may_flow = false;
      const bool gave = (c_.giving[y] & bit) != 0;
      for (int part = 0; part < L::kParts; ++part)
        if (L::in_part(masks.any, part))
          vectors(w, y, part, masks, (deep & bit) != 0, gave, flows, may_flow);
        else if (gave)
          clear(w, y, part);
      if (may_flow) restless |= bit;
      if (flows) giving |= bit;
    }
    // These words gave, and were not looked at now, or have no pairs any more.
    for (TileRow old = c_.giving[y] & ~giving; old != 0; old &= old - 1)
      for (int part = 0; part < L::kParts; ++part) clear(__builtin_ctzll(old), y, part);
    c_.giving[y] = giving;
    if constexpr (kFeatures.hot) keep_heat(y, giving);
    return restless;
  }

 private:
  // Computes R of the axes in row y. D(y) reverses the order of the bits of y.
  [[gnu::always_inline]] void set_dither(int y) {
    dithered_ = y;
    std::uint32_t own = y;
    own = (own & 0x5555) << 1 | (own >> 1 & 0x5555);
    own = (own & 0x3333) << 2 | (own >> 2 & 0x3333);
    own = (own & 0x0F0F) << 4 | (own >> 4 & 0x0F0F);
    own = (own & 0x00FF) << 8 | (own >> 8 & 0x00FF);
    for (int axis = 0; axis < 4; ++axis) {
      const std::uint32_t layer = (step_.pair_dither[axis] + own) & 0xFFFF;
      const std::uint32_t offset = (layer + step_.turn[axis]) / step_.substeps << (axis < 2 ? 2 : 4);
      whole_[axis] = offset >> 16;
      rest_[axis] = 0xFFFF - (offset & 0xFFFF);
    }
  }

  struct Masks {
    std::uint64_t in_run, there[4];  // this cell, the other one of a pair
    std::uint64_t pair[4], any;      // open, and one of them is in a run
    std::uint64_t beside[2][4];      // blocked cells beside the axis pairs
    bool walls;                      // any of them beside a pair
  };

  [[gnu::always_inline]] TileRow deep_words(int y, int z) const {
    return z < v_.nz ? r_.deep[z * v_.ny + y] : 0;
  }
  [[gnu::always_inline]] std::uint64_t in_run(int w, int y, int z) const {
    return w < 0 || w >= v_.words || z >= v_.nz ? 0 : r_.in_run[v_.word(w, y, z)];
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
    for (int axis = 0; axis < 4; ++axis) m.any |= m.pair[axis] &= m.in_run | m.there[axis];
    if (m.any == 0) return false;

    // The axis pairs carry the share of diagonals to blocked cells.
    const std::uint64_t back = v_.blocked(w, y, z_ - 1);
    const std::uint64_t back_right = cpu::from_right(back, v_.blocked(w + 1, y, z_ - 1));
    const std::uint64_t beside[2][4] = {{front, front_right, back, back_right},
                                        {left, right, front_left, front_right}};
    m.walls = false;
    for (int axis = 0; axis < 2; ++axis)
      for (int i = 0; i < 4; ++i) m.walls |= (m.beside[axis][i] = beside[axis][i] & m.pair[axis]) != 0;
    return true;
  }

  struct Cell {
    V head, amount, dead, mobility, fine, limit, bed;
  };

  [[gnu::always_inline]] void vectors(int w, int y, int part, const Masks& m, bool deep, bool gave,
                                      bool& flows, bool& may_flow) {
    const auto lane = static_cast<std::ptrdiff_t>(64 * w + part * L::kCount);
    const auto at = v_.cell(0, y, z_) + lane;
    const std::ptrdiff_t to = y * static_cast<std::ptrdiff_t>(v_.row) + lane;
    const Cell own{L::load(r_.head + at),     L::load(v_.amount + at), L::load(r_.dead + at),
                   L::load(r_.mobility + at), L::load(r_.fine + at),   L::load(r_.limit + at),
                   L::load(r_.bed + at)};
    V flow[4], all = L::zero();
    for (int axis = 0; axis < 4; ++axis) {
      flow[axis] = axis < 2 ? pair<false>(own, at, axis, part, m, deep, may_flow)
                            : pair<true>(own, at, axis, part, m, deep, may_flow);
      all = all | flow[axis];
    }
    const bool moves = L::to_bits(L::equal(all, L::zero())) != kAll;
    if (!moves && !gave) return;
    flows |= moves;
    for (int axis = 0; axis < 4; ++axis) L::store(c_.flow[axis] + to, flow[axis]);
  }

  template <bool kDiagonal>
  [[gnu::always_inline]] V pair(const Cell& own, std::ptrdiff_t at, int axis, int part, const Masks& m,
                                bool deep, bool& may_flow) const {
    const std::ptrdiff_t there = at + to_other_[axis];
    const V head = L::load_any(r_.head + there);
    V down = L::sub_saturated(own.head, head), up = L::sub_saturated(head, own.head);
    if (deep) {
      const Wide a = plumbed(own.head, at), b = plumbed(head, there);
      down = L::narrow({a.low - b.low, a.high - b.high});
      up = L::narrow({b.low - a.low, b.high - a.high});
    }
    const V drop = down | up;
    const M gives = L::less(L::zero(), down);
    // A cell outside a run has a dead zone that no drop exceeds, or (air) nothing below it.
    V dead = L::select(gives, own.dead, L::load_any(r_.dead + there));
    if constexpr (kDiagonal) dead = L::add_saturated(dead, L::high(dead, L::set(3 << 13)));
    const std::uint64_t moves = L::to_bits(L::less(dead, drop)) & (m.pair[axis] >> (part * L::kCount));
    if (moves == 0) return L::zero();

    const M here_runs = L::from_bits(m.in_run, part), there_runs = L::from_bits(m.there[axis], part);
    const V amount = L::load_any(v_.amount + there);
    const V giver = L::select(gives, own.amount, amount), taker = L::select(gives, amount, own.amount);
    const Mobility both = mobilities(own, there, gives, here_runs, there_runs);
    // Between level beds the mean flows. (A giver shows a bed.)
    const V bed = L::load_any(r_.bed + there);
    const V flowing = L::select(L::equal(own.bed, bed), L::mean(own.amount, amount), giver);
    const Conductance c = conductance(both, flowing);
    const M runs = L::from_bits(m.in_run & m.there[axis], part);
    const V room = L::sub_saturated(L::select(runs, L::set(0xFFFF), L::set(4096)), taker);
    V most = L::high(L::min(giver, room), L::set(13107));
    if constexpr (kDiagonal) most = L::template shift_right<2>(most);
    const M gate = L::from_bits(moves << (part * L::kCount), part);

    V beside = L::zero();
    if (!kDiagonal && m.walls)
      for (const std::uint64_t blocked : m.beside[axis])
        beside = beside + L::keep(L::from_bits(blocked, part), L::set(1));
    // (c drive + (R << 10)) >> 26 is computed as (c drive >> 8, and R << 2) >> 18, since the fine bits of c
    // only carry. Diagonals do likewise. In 32 bits a lane, the lower half is not kept.
    const V drive =
        driven<kDiagonal>(L::min(drop, L::set(kDiagonal ? 724 : 512)), gate, own.bed, bed, beside);
    const V fine = L::high(c.fine, drive), low = L::low(c.coarse, drive) + fine;
    const V high = L::add_if(L::less(low, fine), L::high(c.coarse, drive), L::set(1));
    constexpr int kShift = kDiagonal ? 4 : 2;
    const V some = L::min(high | L::template shift_right<kShift>(low), most);  // with the largest R
    if ((L::to_bits(L::less(L::zero(), some)) & moves) != 0) may_flow = true;
    const V sum = L::carry(high + L::set(whole_[axis]), low, L::set(rest_[axis]));
    const V flow = L::keep(gate, L::min(L::template shift_right<kShift>(sum), most));
    return L::select(gives, flow, L::zero() - flow);
  }

  struct Mobility {  // in 1/65536, and 256ths of that in the upper byte
    V coarse, fine;
  };
  struct Conductance {
    V coarse, fine;
  };

  // Limits a mobility by the depth towards a run, and by 1/8 towards a bare flank.
  [[gnu::always_inline]] static Mobility limited(V coarse, V fine, M to_run, V limit) {
    const V most = L::select(to_run, limit, L::set(8192));
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
    const V most = L::select(L::equal(taker, L::zero()), L::set(0xFFFF), giver + giver);
    return {L::min(carried, most), L::keep(L::less(carried, most), all)};
  }

  // Returns (s A) >> 12, at most 2^24 - 1.
  [[gnu::always_inline]] static Conductance conductance(const Mobility& s, V amount) {
    const V fine = L::high(s.fine, amount), low = L::low(s.coarse, amount) + fine;
    const V high = L::add_if(L::less(low, fine), L::high(s.coarse, amount), L::set(1));
    const M over = L::less(L::set(4095), high);
    return {
        L::select(over, L::set(0xFFFF), L::template shift_left<4>(high) | L::template shift_right<12>(low)),
        L::select(over, L::set(0xFF00), L::template shift_left<4>(low) & L::set(0xFF00))};
  }

  // Returns the drop in 1/8192 cell, less on a slope, and more beside blocked cells. Most beds are level, or
  // none, and then nothing is looked up.
  template <bool kDiagonal>
  [[gnu::always_inline]] V driven(V drop, M gate, V bed, V other, V beside) const {
    const V between = L::sub_saturated(bed, other) | L::sub_saturated(other, bed);
    const M none = L::equal(L::min(bed, other), L::zero());
    const V steps = L::keep(gate, L::select(none, L::zero(), L::min(between, L::set(16))));
    const bool walls = !kDiagonal && L::nonzero(beside);
    if (!L::nonzero(steps) && !walls) return L::template shift_left<4>(drop);
    const V at = L::template shift_left<11>(steps);
    V slope = L::lookup(slope_[kDiagonal], at);
    if (walls) slope = slope + L::low(beside, L::template shift_right<3>(L::lookup(slope_[1], at)));
    return L::high(L::template shift_left<6>(drop), slope);
  }

  // Returns heads in 32 bits.
  [[gnu::always_inline]] Wide plumbed(V head, std::ptrdiff_t at) const {
    const M cut = L::equal(head, L::set(0xFFFF));
    return L::unpack(L::select(cut, L::load_any(r_.deep_low + at), head),
                     L::keep(cut, L::load_any(r_.deep_high + at)));
  }

  [[gnu::always_inline]] void clear(int w, int y, int part) {
    for (int axis = 0; axis < 4; ++axis)
      L::store(c_.flow[axis] + y * v_.row + (64 * w + part * L::kCount), L::zero());
  }

  // Keeps the heats of all cells in a pair of these words, because the phase goes on in place.
  [[gnu::always_inline]] void keep_heat(int y, TileRow words) {
    words |= words << 1 | words >> 1;
    if (v_.words < 64) words &= (TileRow{1} << v_.words) - 1;
    for (; words != 0; words &= words - 1) {
      const std::size_t lane = 64 * static_cast<std::size_t>(__builtin_ctzll(words));
      const std::size_t to = y * v_.row + lane;
      for (int next = 0; next < 2 && z_ + next < v_.nz; ++next) {
        const std::uint16_t* from = v_.heat + v_.cell(0, y, z_ + next) + lane;
        for (int part = 0; part < L::kParts; ++part)
          L::store(c_.heat[next] + to + part * L::kCount, L::load(from + part * L::kCount) ^ L::set(0x8000));
      }
    }
  }

  static constexpr std::uint64_t kAll = (std::uint64_t{1} << L::kCount) - 1;
  const View v_;
  const Runs r_;
  const Step& step_;
  const int z_;
  Currents& c_;
  std::ptrdiff_t to_other_[4];  // to the other cell of a pair
  int dithered_ = -1;           // the row of the two below
  // Hold the dither in 1/65536 of what a shift keeps: its whole part, and 65535 less the rest.
  int whole_[4], rest_[4];
  const typename L::Table slope_[2];  // for axes, for diagonals
};

}  // namespace voxmelt::simd
