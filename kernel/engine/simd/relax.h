// Heads relax before the viscous law's spread (docs/automaton.md, section 11). A layer of cells, all of one
// y, relaxes by itself. The code finds what its pairs level in a stage, then runs the stages over those
// vectors that have cells in runs. It is free of kernel/automaton/rule on purpose.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/simd/viscous_pairs.h"

namespace voxmelt::simd {

template <class Arch>
class RelaxLayer : ViscousPairs<Arch, true> {
  using Base = ViscousPairs<Arch, true>;
  using Base::r_, Base::step_, Base::v_;
  using typename Base::Cell, typename Base::Masks, typename Base::Pair;
  using typename Base::L, typename Base::M, typename Base::V, typename Base::Wide;
  using W = typename L::W;

 public:
  [[gnu::always_inline]] RelaxLayer(const View& view, const Step& step, int y, const Runs& runs,
                                    const RelaxMemory& memory)
      : Base(view, step, runs), m_(memory), y_(y), row_(static_cast<std::ptrdiff_t>(view.row)) {}

  [[gnu::always_inline]] void run() {
    if (gather()) {
      const int stages = step_.stages;
      for (int i = 0; i < items_; ++i) begin(i, time(1));
      for (int j = 2; j < stages; ++j)
        for (int i = 0; i < items_; ++i) {
          const Wide change = add(i, j);
          write(i, j & 1, L::sum(integrated(i, time(j)), change));
        }
      for (int i = 0; i < items_; ++i) finish(i, add(i, stages));
    }
    for (int i = 0; i < items_; ++i)
      for (std::uint16_t* leveling : m_.leveling) L::store(leveling + m_.items[i].place, L::zero());
  }

 private:
  // Finds the vectors with cells in runs, and what their pairs level. It tells if any does.
  [[gnu::always_inline]] bool gather() {
    bool any = false;
    for (int z = 0; z < v_.nz; ++z) {
      this->go_to_slice(z);
      const TileRow deep = this->deep_words(y_);
      for (int w = 0; w < v_.words; ++w) {
        const std::uint64_t in_run = r_.in_run[v_.word(w, y_, z)];
        if (in_run == 0) continue;
        Masks masks;
        const bool pairs = this->find_pairs(w, y_, masks);
        for (int part = 0; part < L::kParts; ++part) {
          if (!L::in_part(in_run, part)) continue;
          const std::ptrdiff_t lane = 64 * w + part * L::kCount;
          const RelaxMemory::Item item{(z + 1) * row_ + lane,
                                       static_cast<std::ptrdiff_t>(v_.cell(0, y_, z)) + lane};
          keep_head(items_, item.cell);
          if (pairs && L::in_part(masks.any, part)) any |= level_pairs(item, part, masks, deep >> w & 1);
          m_.items[items_++] = item;
        }
      }
    }
    return any;
  }

  [[gnu::always_inline]] void keep_head(int i, std::ptrdiff_t at) const {
    const V head = L::load(r_.head + at);
    const M cut = L::equal(head, L::set(0xFFFF));
    const V high = L::keep(cut, L::load(r_.deep_high + at));
    const V low = L::select(cut, L::load(r_.deep_low + at), head);
    const M over = L::less(L::set(255), high);  // at most 2^24
    L::store(m_.head + i * L::kCount, L::select(over, L::zero(), low));
    L::store(m_.head_high + i * L::kCount, L::min(high, L::set(256)));
  }

  [[gnu::always_inline]] bool level_pairs(const RelaxMemory::Item& item, int part, const Masks& m,
                                          bool deep) const {
    const Cell own = this->load(item.cell);
    bool any = false;
    for (int axis = 0; axis < 4; ++axis) {
      const std::uint64_t among = m.pair[axis] & m.in_run & m.there[axis];
      if (!L::in_part(among, part)) continue;
      const V leveling = axis < 2 ? level_pair<false>(own, item.cell, axis, part, m, among, deep, any)
                                  : level_pair<true>(own, item.cell, axis, part, m, among, deep, any);
      L::store(m_.leveling[axis] + item.place, leveling);
    }
    return any;
  }

  // Returns what the pairs level of their difference in a stage, in 1/65536, and at most 65535.
  template <bool kDiagonal>
  [[gnu::always_inline]] V level_pair(const Cell& own, std::ptrdiff_t at, int axis, int part, const Masks& m,
                                      std::uint64_t among, bool deep, bool& any) const {
    Pair p;
    if (!this->template look<kDiagonal>(own, at, axis, part, m, among, deep, p)) return L::zero();
    any = true;
    const M gate = L::from_bits(p.moves << (part * L::kCount), part);
    V factor = L::set(16384);
    this->template level<kDiagonal>(p, gate, factor);
    const V flow = L::high(p.conductance.coarse, factor), scale = L::set(step_.relaxed_scale);
    const V high = L::high(flow, scale);
    V cell = high;
    if constexpr (!kDiagonal)
      cell = saturated(L::less(L::set(0x3FFF), high),
                       L::template shift_left<2>(high) | L::template shift_right<14>(L::low(flow, scale)));
    const V cells = L::min(L::load(r_.filled + at), L::load_any(r_.filled + at + Base::to_other_[axis]));
    return L::keep(gate, saturated(L::less(L::zero(), L::high(cells, cell)), L::low(cells, cell)));
  }
  [[gnu::always_inline]] static V saturated(M over, V value) {
    return L::select(over, L::set(0xFFFF), value);
  }

  // Returns the time of a stage before the last one, in 1/65536 of the sub-step.
  [[gnu::always_inline]] int time(int j) const {
    const int stages = step_.stages;
    return 65536 * (j * j + j) / (stages * stages + stages);
  }

  [[gnu::always_inline]] void begin(int i, int at_time) const {
    const Wide none{W(0), W(0)};
    put(m_.impetus, i, none);
    put(m_.change, i, none);
    write(i, 1, integrated(i, at_time));
  }

  // Returns (head time) >> 10.
  [[gnu::always_inline]] Wide integrated(int i, int at_time) const {
    const V head = L::load(m_.head + i * L::kCount), high = L::load(m_.head_high + i * L::kCount);
    const V times = L::set(at_time), upper = L::high(head, times);
    const Wide low =
        L::unpack(L::template shift_right<10>(L::low(head, times)) | L::template shift_left<6>(upper),
                  L::template shift_right<10>(upper));
    if (!L::nonzero(high)) return low;
    const Wide deep = L::product(high, times);
    return {low.low + (deep.low << 6), low.high + (deep.high << 6)};
  }

  // Adds stage j, by the heads of stage j - 1. It returns the change so far.
  [[gnu::always_inline]] Wide add(int i, int j) const {
    const std::ptrdiff_t at = m_.items[i].place;
    const std::uint16_t *low = m_.low[(j - 1) & 1], *high = m_.high[(j - 1) & 1];
    const Wide own = L::unpack(L::load(low + at), L::load(high + at));
    V taken = L::zero(), given = L::zero();
    const std::ptrdiff_t steps[4] = {1, row_, row_ + 1, row_ - 1};
    const V most = L::set(time(j - 1) >> 1);  // one cell all the time
    for (int axis = 0; axis < 4; ++axis)
      for (const bool forth : {true, false}) {
        const std::ptrdiff_t there = forth ? at + steps[axis] : at - steps[axis];
        const V leveling = L::load_any(m_.leveling[axis] + (forth ? at : there));
        const Wide other = L::unpack(L::load_any(low + there), L::load_any(high + there));
        const V up = L::narrow({other.low - own.low, other.high - own.high});
        const V down = L::narrow({own.low - other.low, own.high - other.high});
        taken = L::add_saturated(taken, L::high(leveling, L::min(up, most)));
        given = L::add_saturated(given, L::high(leveling, L::min(down, most)));
      }
    const Wide more = L::widen(taken), less = L::widen(given);
    const W weight(2 * j - 1), part((4096 + j / 2) / j), impetus_most((1 << 20) - 1);
    const auto grown = [&](W impetus, W gain) VOXMELT_LAMBDA {
      return xsimd::min(xsimd::max(impetus + gain * weight, W(0) - impetus_most), impetus_most);
    };
    Wide impetus = get(m_.impetus, i), change = get(m_.change, i);
    impetus = {grown(impetus.low, more.low - less.low), grown(impetus.high, more.high - less.high)};
    change = {change.low + ((impetus.low * part) >> 12), change.high + ((impetus.high * part) >> 12)};
    put(m_.impetus, i, impetus);
    put(m_.change, i, change);
    return change;
  }

  [[gnu::always_inline]] void write(int i, int buffer, Wide head) const {
    L::store(m_.low[buffer] + m_.items[i].place, L::narrow({head.low & W(0xFFFF), head.high & W(0xFFFF)}));
    L::store(m_.high[buffer] + m_.items[i].place, upper_half(head));
  }
  [[gnu::always_inline]] static V upper_half(Wide head) {
    return L::narrow({(head.low >> 16) & W(0xFFFF), (head.high >> 16) & W(0xFFFF)});
  }

  // Writes the heads at the end: 64 times the head, and the change.
  [[gnu::always_inline]] void finish(int i, Wide change) const {
    const V low = L::load(m_.head + i * L::kCount), high = L::load(m_.head_high + i * L::kCount);
    const Wide head = L::sum(L::unpack(L::template shift_left<6>(low),
                                       L::template shift_right<10>(low) | L::template shift_left<6>(high)),
                             change);
    L::store(r_.relaxed_low + m_.items[i].cell, L::narrow({head.low & W(0xFFFF), head.high & W(0xFFFF)}));
    L::store(r_.relaxed_high + m_.items[i].cell, upper_half(head));
  }

  [[gnu::always_inline]] static Wide get(const std::int32_t* from, int i) {
    const std::int32_t* at = from + static_cast<std::ptrdiff_t>(i) * L::kCount;
    return {W::load_aligned(at), W::load_aligned(at + L::kCount / 2)};
  }
  [[gnu::always_inline]] static void put(std::int32_t* to, int i, Wide value) {
    std::int32_t* at = to + static_cast<std::ptrdiff_t>(i) * L::kCount;
    value.low.store_aligned(at);
    value.high.store_aligned(at + L::kCount / 2);
  }

  const RelaxMemory& m_;
  const int y_;
  const std::ptrdiff_t row_;  // between slices, in a layer's memory
  int items_ = 0;
};

}  // namespace voxmelt::simd
