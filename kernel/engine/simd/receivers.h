// Amounts and energy limit the directions that a cell may give to in phase `spread` of the paper's law (Eqs.
// 7, 8).
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/simd/features.h"
#include "kernel/engine/simd/gift_writer.h"

namespace voxmelt::simd {

template <class Arch, SpreadFeatures kFeatures>
class Receivers {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using Bytes = typename L::Bytes;
  using Writer = GiftWriter<Arch, kFeatures>;
  static constexpr int kDirections = kFeatures.eight ? 8 : 4;
  static constexpr int kLimit = rule::receiver_limit(kDirections);
  static constexpr int kDirectionBits = (1 << kDirections) - 1;

 public:
  // Holds what a vector would give to a direction along an axis, and its share of the amount. Neighbours
  // receive if their amount is below `axis` or `diagonal`.
  struct Offer {
    V flow, share;
    V axis, diagonal;
  };

  [[gnu::always_inline]] Receivers(const View& view, const rule::PaperLaw& law, int z, const Gifts& gifts)
      : law_(law),
        threshold_(L::set(law.threshold)),
        margins_(margins(L::set(law.margin))),
        slumps_(kBuilt.slump && law.slump != 0) {
    const std::size_t base = view.cell(0, gifts.first_row, z);
    energy_ = view.energy + base;
    // Rows beyond the grid are masked, so any address will do.
    own_ = view.amount + base;
    front_ = z + 1 < view.nz ? own_ + view.slice : own_;
    back_ = z > 0 ? own_ - view.slice : own_;
  }

  // Finds, for two neighbouring vectors, their offers and the directions that take them.
  [[gnu::always_inline]] Bytes find(std::size_t at, const Writer& writer, Offer& low, Offer& high) const {
    Margins low_margins = margins_, high_margins = margins_;
    if (slumps_) {
      low_margins = margins_of(at);
      high_margins = margins_of(at + L::kCount);
    }
    low = offer(at, low_margins, writer);
    high = offer(at + L::kCount, high_margins, writer);
    Bytes closed = L::none();
    cpu::unrolled<kDirections>([&](auto i) VOXMELT_LAMBDA {
      constexpr int d = kDirections - 1 - i;
      constexpr std::ptrdiff_t dx = d < 4 ? (d == 0) - (d == 1) : (d < 6 ? 1 : -1);
      const std::uint16_t* there = (d < 2 ? own_ : d % 2 == 0 ? front_ : back_) + at + dx;
      const auto full = L::not_less(L::load_any(there), d < 4 ? low.axis : low.diagonal,
                                    L::load_any(there + L::kCount), d < 4 ? high.axis : high.diagonal);
      closed = L::push(closed, full, d);
    });
    if (!slumps_) {  // a cell without energy gives nothing
      const std::uint16_t* energy = energy_ + at;
      closed =
          L::fill(closed, L::not_less(threshold_, L::load(energy), threshold_, L::load(energy + L::kCount)));
    }
    return L::without(L::bytes(kDirectionBits), L::in_order(closed));
  }

 private:
  struct Margins {
    V axis, diagonal;
  };
  [[gnu::always_inline]] static Margins margins(V axis) {
    return {axis, L::add_saturated(axis, L::template shift_right<3>(axis))};
  }
  // Returns the margins of cells. A cell that is starved of energy has a margin of its own.
  [[gnu::always_inline]] Margins margins_of(std::size_t at) const {
    const auto energetic = L::less(threshold_, L::load(energy_ + at));
    return margins(L::select(energetic, margins_.axis, L::set(law_.slump)));
  }

  // Makes the offer of a vector. A neighbour receives if it holds less than the giver's amount less the
  // larger of flow and margin.
  [[gnu::always_inline]] Offer offer(std::size_t at, const Margins& margins, const Writer& writer) const {
    const V amount = L::load(own_ + at);
    const V share = writer.share(at), flow = writer.flow(amount, share);
    const V most = L::set(kLimit);
    V axis = L::min(most, L::sub_saturated(amount, L::max(flow, margins.axis)));
    V diagonal = L::min(most, L::sub_saturated(amount, L::max(flow, margins.diagonal)));
    if constexpr (kFeatures.general)
      if (!law_.downhill) axis = diagonal = most;
    return {flow, share, axis, diagonal};
  }

  const rule::PaperLaw& law_;
  const V threshold_;
  const Margins margins_;
  const bool slumps_;
  const std::uint16_t *energy_, *own_, *front_, *back_;  // amounts in this slice and the ones beside it
};

}  // namespace voxmelt::simd
