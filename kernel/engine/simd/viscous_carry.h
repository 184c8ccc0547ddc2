// In the second half of phase `spread` of the viscous law, every cell of one slice sums the exchange of its
// eight pairs, in place.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/simd/features.h"
#include "kernel/engine/simd/kernels.h"
#include "kernel/engine/simd/mix.h"

namespace voxmelt::simd {

template <class Arch, ViscousFeatures kFeatures>
class Carry {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;

 public:
  [[gnu::always_inline]] Carry(const View& view, const Step& step, int z, const Currents& below,
                               const Currents& own, Books& books)
      : v_(view), z_(z), below_(below), own_(own), books_(books), mix_(step.dither) {}

  // Returns the words of row y that changed.
  [[gnu::always_inline]] TileRow row(int y) {
    const TileRow giving = below_.giving[y] | own_.giving[y];
    if (giving == 0) return 0;
    TileRow work = giving | giving << 1 | giving >> 1, changed = 0;
    if (v_.words < 64) work &= (TileRow{1} << v_.words) - 1;
    for (; work != 0; work &= work - 1) {
      const int w = __builtin_ctzll(work);
      std::uint64_t wet = 0;
      bool differs = false;
      for (int part = 0; part < L::kParts; ++part) wet |= vectors(w, y, part, differs) << (part * L::kCount);
      if (!differs) continue;
      changed |= work & -work;
      const std::size_t mask = v_.word(w, y, z_);
      v_.liquid[mask] = wet & ~(v_.solid[mask] | v_.inert[mask]);
    }
    if constexpr (kFeatures.hot) books_.heat.rounded += mix_.flush();
    return changed;
  }

 private:
  // Changes one part of a word. It returns the lanes that are liquid, or hold something else.
  [[gnu::always_inline]] std::uint64_t vectors(int w, int y, int part, bool& differs) {
    const auto lane = static_cast<std::ptrdiff_t>(64 * w + part * L::kCount);
    const std::ptrdiff_t at = y * static_cast<std::ptrdiff_t>(v_.row) + lane;
    const auto cell = v_.cell(0, y, z_) + lane;
    const V gains[8] = {L::zero() - L::load(own_.flow[0] + at), L::load_any(own_.flow[0] + at - 1),
                        L::zero() - L::load(own_.flow[1] + at), L::load(below_.flow[1] + at),
                        L::zero() - L::load(own_.flow[2] + at), L::load_any(below_.flow[2] + at - 1),
                        L::zero() - L::load(own_.flow[3] + at), L::load_any(below_.flow[3] + at + 1)};
    V net = L::zero(), any = L::zero();
    for (const V& gain : gains) {
      net = net + gain;
      any = any | gain;
    }
    if (!L::nonzero(any)) return v_.liquid[v_.word(w, y, z_)] >> (part * L::kCount) & kAll;
    const V now = L::load(v_.amount + cell) + net;
    const M dry = L::equal(now, L::zero());
    V difference = net;
    L::store(v_.amount + cell, now);

    if constexpr (kFeatures.hot) {
      const std::uint16_t* const heats[8] = {own_.heat[0] + 1, own_.heat[0] - 1,  own_.heat[1],
                                             below_.heat[0],   own_.heat[1] + 1,  below_.heat[0] - 1,
                                             own_.heat[1] - 1, below_.heat[0] + 1};
      V in = L::zero();
      typename L::Wide content{};
      for (int d = 0; d < 8; d += 2) {
        const V first = positive(gains[d]), second = positive(gains[d + 1]);
        in = in + first + second;
        const auto pair =
            L::pair_product(first, L::load_any(heats[d] + at), second, L::load_any(heats[d + 1] + at));
        content = d == 0 ? pair : L::sum(content, pair);
      }
      const V heat = L::load(v_.heat + cell);
      const M fed = L::less(L::zero(), in);
      V mixed = heat;
      if (L::to_bits(fed) != 0) {
        // Heats of givers are 32768 less, to be signed. So 32768 times the incoming amount is put back.
        const auto biased = L::unpack(L::template shift_left<15>(in), L::template shift_right<1>(in));
        const auto all = L::sum(L::sum(content, biased), L::product(now - in, heat));
        mixed = L::select(fed, mix_.mean(all, now, fed), heat);
      }
      const V left = L::select(dry, L::zero(), mixed);
      L::store(v_.heat + cell, left);
      difference = difference | (heat ^ left);
    }
    if (L::to_bits(L::equal(difference, L::zero())) != kAll) differs = true;
    return L::to_bits(dry) ^ kAll;
  }

  // Returns a signed lane, or 0.
  [[gnu::always_inline]] static V positive(V v) {
    using Signed = xsimd::batch<std::int16_t, Arch>;
    return xsimd::bitwise_cast<V>(xsimd::max(xsimd::bitwise_cast<Signed>(v), Signed(std::int16_t{0})));
  }

  static constexpr std::uint64_t kAll = (std::uint64_t{1} << L::kCount) - 1;
  const View v_;
  const int z_;
  const Currents &below_, &own_;
  Books& books_;
  Mix<Arch> mix_;
};

}  // namespace voxmelt::simd
