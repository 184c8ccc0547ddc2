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
#include "kernel/engine/simd/viscous_pairs.h"

namespace voxmelt::simd {

template <class Arch, ViscousFeatures kFeatures>
class ExchangePairs : ViscousPairs<Arch, kFeatures.relaxed> {
  using Base = ViscousPairs<Arch, kFeatures.relaxed>;
  using Base::r_, Base::step_, Base::to_other_, Base::v_, Base::z_;
  using typename Base::Cell, typename Base::Masks, typename Base::Pair;
  using typename Base::L, typename Base::M, typename Base::V, typename Base::Wide;

 public:
  [[gnu::always_inline]] ExchangePairs(const View& view, const Step& step, int z, const Runs& runs,
                                       Currents& currents)
      : Base(view, step, runs), c_(currents) {
    this->go_to_slice(z);
  }

  // Computes row y. It returns the restless words.
  [[gnu::always_inline]] TileRow row(int y, TileRow work) {
    if ((work | c_.giving[y]) == 0) return 0;
    TileRow restless = 0, giving = 0;
    if (v_.words < 64) work &= (TileRow{1} << v_.words) - 1;
    const TileRow deep = this->deep_words(y);
    for (; work != 0; work &= work - 1) {
      const int w = __builtin_ctzll(work);
      const TileRow bit = work & -work;
      Masks masks;
      if (!this->find_pairs(w, y, masks)) continue;
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
      const std::uint32_t turned = (layer + step_.turn[axis]) / step_.substeps;
      const std::uint32_t offset = kFeatures.relaxed ? turned << (axis < 2 ? 3 : 5) >> step_.relaxed_bits
                                                     : turned << (axis < 2 ? 2 : 4);
      whole_[axis] = offset >> 16;
      rest_[axis] = kFeatures.relaxed ? offset & 0xFFFF : 0xFFFF - (offset & 0xFFFF);
    }
  }

  [[gnu::always_inline]] void vectors(int w, int y, int part, const Masks& m, bool deep, bool gave,
                                      bool& flows, bool& may_flow) {
    const auto lane = static_cast<std::ptrdiff_t>(64 * w + part * L::kCount);
    const auto at = v_.cell(0, y, z_) + lane;
    const std::ptrdiff_t to = y * static_cast<std::ptrdiff_t>(v_.row) + lane;
    const Cell own = this->load(at);
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
    Pair p;
    if (!this->template look<kDiagonal>(own, at, axis, part, m, m.pair[axis], deep, p)) return L::zero();
    const M runs = L::from_bits(m.in_run & m.there[axis], part);
    V drop;
    if constexpr (kFeatures.relaxed) {
      drop = this->template relaxed_drop<kDiagonal>(p, at, axis, runs);
      this->keep_set(m, axis, part, p);  // where liquid flows back
      if (p.moves == 0) return L::zero();
    }
    const V room = L::sub_saturated(L::select(runs, L::set(0xFFFF), L::set(4096)), p.taker);
    V most = L::high(L::min(p.giver, room), L::set(13107));
    if constexpr (kDiagonal) most = L::template shift_right<2>(most);
    const M gate = L::from_bits(p.moves << (part * L::kCount), part);
    V flow;
    if constexpr (kFeatures.relaxed) {
      may_flow = true;
      flow = L::min(relaxed<kDiagonal>(p, drop, axis, gate), most);
    } else {
      flow = L::min(wanted<kDiagonal>(p, axis, gate, most, may_flow), most);
    }
    flow = L::keep(gate, flow);
    return L::select(p.gives, flow, L::zero() - flow);
  }

  // (c drive + (R << 10)) >> 26 is computed as (c drive >> 8, and R << 2) >> 18, since the fine bits of c
  // only carry. Diagonals do likewise. In 32 bits a lane, the lower half is not kept.
  template <bool kDiagonal>
  [[gnu::always_inline]] V wanted(const Pair& p, int axis, M gate, V most, bool& may_flow) const {
    V drive = L::min(p.drop, L::set(kDiagonal ? 724 : 512)), factor;  // in 1/8192 cell
    drive = this->template level<kDiagonal>(p, gate, factor)
                ? L::template shift_left<4>(drive)
                : L::high(L::template shift_left<6>(drive), factor);
    const V fine = L::high(p.conductance.fine, drive), low = L::low(p.conductance.coarse, drive) + fine;
    const V high = L::add_if(L::less(low, fine), L::high(p.conductance.coarse, drive), L::set(1));
    constexpr int kShift = kDiagonal ? 4 : 2;
    const V some = L::min(high | L::template shift_right<kShift>(low), most);  // with the largest R
    if ((L::to_bits(L::less(L::zero(), some)) & p.moves) != 0) may_flow = true;
    const V sum = L::carry(high + L::set(whole_[axis]), low, L::set(rest_[axis]));
    return L::template shift_right<kShift>(sum);
  }

  // Returns the drop of relaxed heads, in 1/32768 cell, and turns the pair round if it is below 0.
  template <bool kDiagonal>
  [[gnu::always_inline]] V relaxed_drop(Pair& p, std::ptrdiff_t at, int axis, M runs) const {
    constexpr int kMost = kDiagonal ? 724 : 512;
    const std::ptrdiff_t there = at + to_other_[axis];
    const Wide a = L::unpack(L::load(r_.relaxed_low + at), L::load(r_.relaxed_high + at));
    const Wide b = L::unpack(L::load_any(r_.relaxed_low + there), L::load_any(r_.relaxed_high + there));
    const V down = L::narrow({a.low - b.low, a.high - b.high});
    const V up = L::narrow({b.low - a.low, b.high - a.high});
    const V own_drop = L::template shift_left<6>(L::min(p.drop, L::set(kMost)));
    const V gives = L::keep(p.gives, L::set(1));
    const V now = L::select(
        runs, L::select(L::less(L::zero(), down | up), L::keep(L::less(up, down), L::set(1)), gives), gives);
    const M turns = L::less(L::zero(), gives ^ now);
    const V giver = L::select(turns, p.taker, p.giver);
    p.taker = L::select(turns, p.giver, p.taker);
    p.giver = giver;
    p.gives = L::less(L::zero(), now);
    return L::min(L::select(runs, down | up, own_drop), L::set(64 * kMost));
  }

  // Returns what relaxed heads let flow, at most 65535. (c drive >> (8 + bits)) has 32 bits.
  template <bool kDiagonal>
  [[gnu::always_inline]] V relaxed(const Pair& p, V drop, int axis, M gate) const {
    V drive = L::template shift_right<1>(drop), factor;  // in 1/16384 cell
    if (!this->template level<kDiagonal>(p, gate, factor))
      drive = L::high(drop, L::template shift_left<1>(factor));

    const V fine = L::high(p.conductance.fine, drive), product = L::low(p.conductance.coarse, drive);
    const V low = product + fine;
    V high = L::add_if(L::less(low, fine), L::high(p.conductance.coarse, drive), L::set(1));
    const V sum = low + L::set(rest_[axis]);
    high = L::add_if(L::less(sum, low), high + L::set(whole_[axis]), L::set(1));
    // The sum is shifted to the right by 19 or 21, less bits.
    const int left = step_.relaxed_bits - (kDiagonal ? 5 : 3);
    if (left < 0) return L::high(high, L::set(1 << (16 + left)));
    const V shifted = L::low(high, L::set(1 << left)) | L::high(sum, L::set(1 << left));
    return L::select(L::less(L::set(0xFFFF >> left), high), L::set(0xFFFF), shifted);
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
  Currents& c_;
  int dithered_ = -1;  // the row of the two below
  // Hold the dither of the rounding: its upper half, and 65535 less the lower half. Where heads relax, that
  // is the lower half itself.
  int whole_[4], rest_[4];
};

}  // namespace voxmelt::simd
