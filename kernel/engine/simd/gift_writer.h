// Cells give to a direction in phase `spread` of the paper's law (Eqs. 9, 10). Their gifts are written here.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/simd/contact.h"
#include "kernel/engine/simd/features.h"

namespace voxmelt::simd {

template <class Arch, SpreadFeatures kFeatures>
class GiftWriter {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  static constexpr int kDirections = kFeatures.eight ? 8 : 4;
  static constexpr int kCap = rule::flow_cap(kDirections);

 public:
  [[gnu::always_inline]] GiftWriter(const View& view, const Step& step, int z, const Gifts& gifts)
      : law_(step.parameters->flow.paper),
        z_(z),
        gifts_(gifts),
        amount_(view.amount + view.cell(0, gifts.first_row, z)),
        energy_(view.energy + view.cell(0, gifts.first_row, z)),
        heat_(view.heat + view.cell(0, gifts.first_row, z)),
        share_(L::set(law_.share)) {
    if constexpr (kFeatures.thermal) shares_ = share_table(*step.parameters);
  }

  // Returns the share of their contents that cells give. With thermal viscosity, it is the share times the
  // table.
  [[gnu::always_inline]] V share(std::size_t at) const {
    if constexpr (!kFeatures.thermal) return share_;
    return L::lookup(shares_, L::load(heat_ + at));
  }
  // Returns the amount along an axis. With shares by pattern it is not known yet, and is 0.
  [[gnu::always_inline]] V flow(V amount, V share) const {
    if constexpr (kFeatures.general)
      if (law_.use_table) return L::zero();
    return capped(amount, share);
  }

  // Writes one gift for all directions of an axis. The gift to a diagonal is its quarter. `apply` takes that
  // quarter when it reads the gift, unless sums under a mask are free.
  [[gnu::always_inline]] void write(std::size_t at, V flow, V share) const {
    const V warm = L::min(flow, L::high(L::load(energy_ + at), share));
    L::store(gifts_.flow[0] + at, flow);
    L::store(gifts_.energy[0] + at, warm);
    if constexpr (kFeatures.eight && L::kMaskedSums) {
      L::store(gifts_.flow[4] + at, L::template shift_right<2>(flow));
      L::store(gifts_.energy[4] + at, L::template shift_right<2>(warm));
    }
    write_heat(at);
  }

  // Writes the gifts of every direction on their own: shares by pattern, energy by the printed reading.
  [[gnu::always_inline]] void write_each(const View& view, std::size_t at, int y, std::uint32_t lane) const {
    const V amount = L::load(amount_ + at), energy = L::load(energy_ + at);
    write_heat(at);
    const V same = law_.use_table ? L::zero() : share(at);
    for (int d = 0; d < kDirections; ++d) {
      const V sh = law_.use_table ? share_by_pattern(gifts_.pattern + at, d) : same;
      V flow = capped(amount, sh), warm = capped(energy, sh);
      if (d >= 4) {
        flow = L::template shift_right<2>(flow);
        warm = L::template shift_right<2>(warm);
      }
      warm = L::min(flow, warm);
      if (law_.reading == rule::EnergyReading::printed)
        warm = L::high(warm, contact_alpha<Arch>(view, law_, y == 0, view.word(lane / 64, y, z_),
                                                 static_cast<int>(lane % 64 / L::kCount)));
      L::store(gifts_.flow[d] + at, flow);
      L::store(gifts_.energy[d] + at, warm);
    }
  }

 private:
  [[gnu::always_inline]] static V capped(V value, V share) {
    return L::min(L::high(value, share), L::set(kCap));
  }
  [[gnu::always_inline]] void write_heat(std::size_t at) const {
    if constexpr (kFeatures.hot) L::store(gifts_.heat + at, L::load(heat_ + at) ^ L::set(0x8000));
  }

  // Returns the shares by heat, limited to what all neighbours together can take.
  [[gnu::always_inline]] static typename L::Table share_table(const rule::Parameters& parameters) {
    alignas(64) std::uint16_t shares[32];
    const V sh = L::set(parameters.flow.paper.share);  // below 2^15
    for (std::size_t i = 0; i < 32; i += L::kCount) {
      const V mobility = L::load_any(parameters.flow.mobility_table.data() + i);
      // The product >> 15 may need 17 bits. The limit brings it back to 16.
      const V high = L::high(sh, mobility), low = L::template shift_right<15>(L::low(sh, mobility));
      L::store(shares + i, L::min(L::add_saturated(L::add_saturated(high, high), low),
                                  L::set(rule::largest_share(kDirections))));
    }
    return L::table(shares);
  }
  [[gnu::always_inline]] V share_by_pattern(const std::uint8_t* patterns, int d) const {
    alignas(64) std::uint16_t shares[L::kCount];
    for (int i = 0; i < L::kCount; ++i) shares[i] = law_.table[patterns[i] & 15][d];
    return L::load(shares);
  }

  const rule::PaperLaw& law_;
  const int z_;
  const Gifts& gifts_;
  const std::uint16_t *const amount_, *const energy_, *const heat_;  // from the gifts' first row on
  const V share_;
  typename L::Table shares_;  // by heat, for thermal viscosity
};

}  // namespace voxmelt::simd
