// Heat keeps its order when runs settle (docs/automaton.md, section 10). The parts of the runs of one word of
// columns move through the faces between their cells. A scan upwards, then one downwards, hand on the moving
// parts.
#pragma once

#include <cstdint>

#include "kernel/engine/cpu/lanes.h"
#include "kernel/engine/simd/mix.h"

namespace voxmelt::simd {

template <class Arch>
class RunOrder {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;
  using W = typename L::W;
  using Wide = typename L::Wide;

 public:
  // Begins runs at their first cells. Nothing flows to them, since no run gives beyond its last cell.
  [[gnu::always_inline]] void begin(int part, Wide kept) {
    Part& p = parts_[part];
    p.most = {p.most.low & kept.low, p.most.high & kept.high};
    if (p.lifted) p.rounded = {p.rounded.low & kept.low, p.rounded.high & kept.high};
  }

  // Notes the excess at the face that the scan upwards comes to.
  [[gnu::always_inline]] void meet(int part, Wide excess) {
    Part& p = parts_[part];
    p.most = {xsimd::max(p.most.low, xsimd::abs(excess.low)),
              xsimd::max(p.most.high, xsimd::abs(excess.high))};
  }

  // Moves upwards: a cell takes the flow from below and gives `up`.
  [[gnu::always_inline]] void lift(int part, const Mix<Arch>& mix, V up, std::uint16_t* amount,
                                   std::uint16_t* heat) {
    Part& p = parts_[part];
    const V held = L::load(amount);
    V own = L::load(heat);
    if (p.moves) {
      own = take(p, mix, held, own, [&](V more, V less) VOXMELT_LAMBDA {
        const Wide high = L::widen(more), low = L::widen(less);
        p.rounded = L::sum(p.rounded, {high.low - low.low, high.high - low.high});
      });
      L::store(heat, own);
      p.lifted = true;
    }
    L::store(amount, held + p.flow - up);
    hand_on(p, up, own);
  }

  // Moves downwards, where `ordered`: a cell takes the flow from above, keeps `settled` and gives the rest.
  // It returns the cell's heat.
  [[gnu::always_inline]] V sink(int part, Mix<Arch>& mix, M ordered, V held, V heat, V settled) {
    Part& p = parts_[part];
    const V down = L::keep(ordered, held + p.flow - settled);
    if (p.moves)
      heat = take(p, mix, held, heat, [&](V more, V less) VOXMELT_LAMBDA { mix.book(more, less); });
    hand_on(p, down, heat);
    return heat;
  }

  // Tells if something flows to the next cells of the scan.
  [[gnu::always_inline]] bool moves(int part) const { return parts_[part].moves; }
  // Ends runs where `ended`, with their total excess. It returns the lanes of those that keep their order.
  // The mixing of the others on the way up is forgotten.
  [[gnu::always_inline]] std::uint64_t end(int part, M ended, Wide excess) {
    constexpr int kMost = 65535 - 4096;
    Part& p = parts_[part];
    const V beyond = L::sub_saturated(L::narrow(p.most), L::set(kMost)) | L::narrow(excess);
    const V ordered = L::keep(ended, L::select(L::equal(beyond, L::zero()), L::set(0xFFFF), L::zero()));
    if (p.lifted) {
      const Wide kept = L::unpack(ordered, ordered);
      p.booked = L::sum(p.booked, {p.rounded.low & kept.low, p.rounded.high & kept.high});
    }
    return L::to_bits(L::less(L::zero(), ordered));
  }
  // Returns the rounding by mixing on the way up in runs that keep their order, in all columns so far.
  [[gnu::always_inline]] std::int64_t flush() {
    std::int64_t total = 0;
    for (Part& p : parts_) {
      if (!p.lifted) continue;
      alignas(64) std::int32_t lanes[L::kCount];  // at most 65535 in each cell of a column
      p.booked.low.store_aligned(lanes);
      p.booked.high.store_aligned(lanes + L::kCount / 2);
      for (const std::int32_t lane : lanes) total += lane;
      p.lifted = false;
      p.booked = p.rounded = Wide{W(0), W(0)};
    }
    return total;
  }

 private:
  // Is the state of a scan. In lanes of runs that do not keep their order, the moving parts are of no use to
  // anybody.
  struct Part {
    V flow = L::zero(), heat = L::zero();  // flow through the face to the cell that follows
    bool moves = false;                    // a flow is not 0
    Wide most{W(0), W(0)};                 // greatest |excess| at the faces so far
    bool lifted = false;                   // since the last flush; if not, the two that follow are 0
    Wide rounded{W(0), W(0)}, booked{W(0), W(0)};
  };

  template <class Book>
  [[gnu::always_inline]] static V take(const Part& p, const Mix<Arch>& mix, V held, V heat,
                                       const Book& book) {
    return L::select(L::less(L::zero(), p.flow), mix.two(held, heat, p.flow, p.heat, book), heat);
  }
  [[gnu::always_inline]] static void hand_on(Part& p, V flow, V heat) {
    p.flow = flow;
    p.heat = heat;
    p.moves = L::nonzero(flow);
  }

  Part parts_[L::kParts];
};

}  // namespace voxmelt::simd
