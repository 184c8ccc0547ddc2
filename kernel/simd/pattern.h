// Phase `spread` of the paper's law, first half (Eqs. 7-10): which directions each cell gives to, and what.
// Row by row of one slice, 64 cells at a time.
#pragma once

#include "kernel/simd/contact.h"
#include "kernel/simd/features.h"

namespace voxmelt::simd {

template <class Arch, SpreadFeatures kFeatures>
class Pattern {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;
  static constexpr int kDirections = kFeatures.eight ? 8 : 4;

 public:
  [[gnu::always_inline]] Pattern(const View& view, const Step& step, int z, Gifts& gifts)
      : v_(view),
        step_(step),
        law_(step.parameters->flow.paper),
        table_(step.parameters->flow.mobility_table.data()),
        z_(z),
        gifts_(gifts) {}

  // `y` of one row; adds to restless.
  [[gnu::always_inline]] TileRow row(int y, TileRow work) {
    for (TileRow old = gifts_.giving[y]; old != 0; old &= old - 1) {
      std::uint64_t* planes = gifts_.planes + gift_word(__builtin_ctzll(old), y);
      for (int d = 0; d < 8; ++d) planes[d] = 0;
    }
    TileRow restless = 0, giving = 0;
    for (; work != 0; work &= work - 1) {
      const int w = __builtin_ctzll(work);
      std::uint64_t givers = v_.liquid[v_.word(w, y, z_)];
      if (givers == 0) continue;
      if (law_.support) givers &= supported(w, y);
      if (givers == 0) continue;

      std::uint64_t planes[8];
      open_directions(w, y, givers, planes);
      if (!find_available(w, y, planes)) continue;
      restless |= TileRow{1} << w;
      if (throw_dice(w, y, planes)) {
        giving |= TileRow{1} << w;
        if constexpr (kFeatures.general) give(w, y, planes);
      }
    }
    gifts_.giving[y] = giving;
    return restless;
  }

 private:
  [[gnu::always_inline]] std::uint64_t supported(int w, int y) const {
    if (y == 0) return ~std::uint64_t{0};
    return v_.blocked(w, y - 1, z_) | v_.liquid[v_.word(w, y - 1, z_)];
  }

  // planes[d]: givers whose neighbour in direction d is open.
  [[gnu::always_inline]] void open_directions(int w, int y, std::uint64_t givers,
                                              std::uint64_t* planes) const {
    const std::uint64_t own = v_.blocked(w, y, z_);
    const std::uint64_t right = cpu::from_right(own, v_.blocked(w + 1, y, z_));
    const std::uint64_t left = cpu::from_left(own, v_.blocked(w - 1, y, z_));
    const std::uint64_t front = v_.blocked(w, y, z_ + 1), back = v_.blocked(w, y, z_ - 1);
    planes[0] = givers & ~right;
    planes[1] = givers & ~left;
    planes[2] = givers & ~front;
    planes[3] = givers & ~back;
    if constexpr (kFeatures.eight) {
      const std::uint64_t front_right = cpu::from_right(front, v_.blocked(w + 1, y, z_ + 1));
      const std::uint64_t front_left = cpu::from_left(front, v_.blocked(w - 1, y, z_ + 1));
      const std::uint64_t back_right = cpu::from_right(back, v_.blocked(w + 1, y, z_ - 1));
      const std::uint64_t back_left = cpu::from_left(back, v_.blocked(w - 1, y, z_ - 1));
      planes[4] = givers & ~(front_right | (right & front));
      planes[5] = givers & ~(back_right | (right & back));
      planes[6] = givers & ~(front_left | (left & front));
      planes[7] = givers & ~(back_left | (left & back));
    }
  }

  // Leaves in planes the directions that receive; false where there is none. Lean: writes the gifts, too.
  [[gnu::always_inline]] bool find_available(int w, int y, std::uint64_t* planes) {
    const std::size_t cell = v_.cell(w, y, z_);
    const std::size_t gift = static_cast<std::size_t>(y) * v_.row + 64 * static_cast<std::size_t>(w);
    constexpr int kCap = kFeatures.eight ? 4096 : 8192, kLimit = kFeatures.eight ? 11 * 4096 : 8 * 4096;
    // The neighbour's place; beyond the grid its own: a masked lane.
    const std::ptrdiff_t front = z_ + 1 < v_.nz ? static_cast<std::ptrdiff_t>(v_.slice) : 0;
    const std::ptrdiff_t back = z_ > 0 ? -static_cast<std::ptrdiff_t>(v_.slice) : 0;
    const std::ptrdiff_t offsets[8] = {1, -1, front, back, front + 1, back + 1, front - 1, back - 1};
    std::uint64_t found[8] = {};

    for (int part = 0; part < L::kParts; ++part) {
      const std::size_t at = static_cast<std::size_t>(part * L::kCount);
      const V amount = L::load(v_.amount + cell + at), energy = L::load(v_.energy + cell + at);
      const M energetic = L::less(L::set(law_.threshold), energy);
      V flow, axis_limit, diagonal_limit;
      if constexpr (kFeatures.general) {
        flow = law_.use_table ? L::zero() : L::min(L::high(amount, share(cell + at)), L::set(kCap));
      } else {
        const V sh = L::set(law_.share);
        flow = L::min(L::high(amount, sh), L::set(kCap));
        L::store(gifts_.flow[0] + gift + at, flow);
        L::store(gifts_.energy[0] + gift + at, L::min(flow, L::high(energy, sh)));
        if constexpr (kFeatures.hot)
          L::store(gifts_.heat + gift + at, L::load(v_.temperature + cell + at) ^ L::set(0x8000));
      }
      const V margin = L::select(energetic, L::set(law_.margin), L::set(law_.slump));
      // A neighbour receives if it holds less than a limit: the giver's amount less the larger of flow and
      // margin.
      const V most = L::set(kLimit);
      axis_limit = L::min(most, L::sub_saturated(amount, L::max(flow, margin)));
      if constexpr (kFeatures.eight) {
        const V diagonal_margin = L::add_saturated(margin, L::template shift_right<3>(margin));
        diagonal_limit = L::min(most, L::sub_saturated(amount, L::max(flow, diagonal_margin)));
      }
      if constexpr (kFeatures.general)
        if (!law_.downhill) axis_limit = diagonal_limit = most;
      std::uint64_t spreads = kAll;
      if (law_.slump == 0) spreads = L::to_bits(energetic);

      for (int d = 0; d < kDirections; ++d) {
        const V there = L::load_any(v_.amount + static_cast<std::ptrdiff_t>(cell + at) + offsets[d]);
        found[d] |= (L::to_bits(L::less(there, d < 4 ? axis_limit : diagonal_limit)) & spreads)
                    << (part * L::kCount);
      }
    }
    std::uint64_t any = 0;
    for (int d = 0; d < kDirections; ++d) any |= planes[d] &= found[d];
    return any != 0;
  }

  // Keeps a random subset of the directions.
  [[gnu::always_inline]] bool throw_dice(int w, int y, std::uint64_t* planes) {
    std::uint64_t dice[8];
    const auto blocks = (static_cast<std::uint32_t>(v_.nx) + 7) / 8;
    const auto row =
        static_cast<std::uint32_t>(z_) * static_cast<std::uint32_t>(v_.ny) + static_cast<std::uint32_t>(y);
    L::random_planes(step_.keys, step_.number, row * blocks + 8 * static_cast<std::uint32_t>(w), dice);
    std::uint64_t any = 0;
    for (int d = 0; d < kDirections; ++d) any |= planes[d] &= dice[d];
    if (any == 0) return false;
    std::uint64_t* out = gifts_.planes + gift_word(w, y);
    for (int d = 0; d < kDirections; ++d) out[d] = planes[d];
    return true;
  }
  [[gnu::always_inline]] std::size_t gift_word(int w, int y) const {
    return 8 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(v_.words + 2) + 1 +
                static_cast<std::size_t>(w));
  }

  [[gnu::always_inline]] V share(std::size_t cell) const {
    if (!step_.parameters->flow.thermal_viscosity) return L::set(law_.share);
    alignas(64) std::uint16_t shares[L::kCount];
    for (int i = 0; i < L::kCount; ++i) {
      const std::uint32_t mobility = table_[v_.temperature[cell + static_cast<std::size_t>(i)] >> 11];
      const std::uint32_t scaled = (law_.share * mobility) >> 15, most = kFeatures.eight ? 13107 : 16384;
      shares[i] = static_cast<std::uint16_t>(scaled < most ? scaled : most);
    }
    return L::load(shares);
  }

  // The gifts of every direction on their own: shares by pattern or by heat, energy by the printed reading.
  [[gnu::always_inline]] void give(int w, int y, const std::uint64_t* planes) {
    constexpr int kCap = kFeatures.eight ? 4096 : 8192;
    const std::size_t cell = v_.cell(w, y, z_);
    const std::size_t gift = static_cast<std::size_t>(y) * v_.row + 64 * static_cast<std::size_t>(w);
    for (int part = 0; part < L::kParts; ++part) {
      const std::size_t at = static_cast<std::size_t>(part * L::kCount);
      const V amount = L::load(v_.amount + cell + at), energy = L::load(v_.energy + cell + at);
      if constexpr (kFeatures.hot)
        L::store(gifts_.heat + gift + at, L::load(v_.temperature + cell + at) ^ L::set(0x8000));
      const V same = law_.use_table ? L::zero() : share(cell + at);
      for (int d = 0; d < kDirections; ++d) {
        const V sh = law_.use_table ? share_by_pattern(planes, part, d) : same;
        V flow = L::min(L::high(amount, sh), L::set(kCap)), warm = L::min(L::high(energy, sh), L::set(kCap));
        if (d >= 4) {
          flow = L::template shift_right<2>(flow);
          warm = L::template shift_right<2>(warm);
        }
        warm = L::min(flow, warm);
        if (law_.reading == rule::EnergyReading::printed)
          warm = L::high(warm, contact_alpha<Arch>(v_, law_, w, y, z_, part));
        L::store(gifts_.flow[d] + gift + at, flow);
        L::store(gifts_.energy[d] + gift + at, warm);
      }
    }
  }
  [[gnu::always_inline]] V share_by_pattern(const std::uint64_t* planes, int part, int d) const {
    alignas(64) std::uint16_t shares[L::kCount];
    for (int i = 0; i < L::kCount; ++i) {
      const int bit = part * L::kCount + i;
      std::size_t pattern = 0;
      for (std::size_t k = 0; k < 4; ++k) pattern |= (planes[k] >> bit & 1u) << k;
      shares[i] = (&law_.table[0][0])[4 * pattern + static_cast<std::size_t>(d)];
    }
    return L::load(shares);
  }

  static constexpr std::uint64_t kAll = (std::uint64_t{1} << L::kCount) - 1;
  const View v_;
  const Step& step_;
  const rule::PaperLaw& law_;
  const std::uint16_t* table_;
  const int z_;
  Gifts& gifts_;
};

}  // namespace voxmelt::simd
