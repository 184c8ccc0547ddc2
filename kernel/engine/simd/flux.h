// Heat flows between two cells (Eq. 1, docs/automaton.md, section 6), 16 bits a lane. The code is free of
// kernel/automaton/rule on purpose: compared with it, not built from it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/lanes.h"
#include "kernel/engine/simd/features.h"
#include "kernel/engine/simd/kernels.h"

namespace voxmelt::simd {

// Returns the cells that are solid or liquid. There are none beyond the grid.
VOXMELT_LANES std::uint64_t matter(const View& v, int w, int y, int z) {
  if (w < 0 || w >= v.words || y < 0 || y >= v.ny || z < 0 || z >= v.nz) return 0;
  const std::size_t at = v.word(w, y, z);
  return v.solid[at] | v.liquid[at];
}

// Returns D(s, part, parts).
VOXMELT_LANES std::uint32_t part_dither(const Step& step, int part, int parts) {
  return (step.dither + 65536u * part / parts) & 0xFFFFu;
}

// Returns the temperature of a heat content. It stays at the melting point while the latent heat is paid.
template <class Arch, bool kLatent>
class Plateau {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;

 public:
  [[gnu::always_inline]] explicit Plateau(const rule::Material& material)
      : melting_(L::set(material.melting_point)),
        latent_(L::set(material.latent_heat)),
        least_liquid_from_(material.melting_point + material.latent_heat) {}
  [[gnu::always_inline]] explicit Plateau(const rule::Parameters& parameters)
      : Plateau(parameters.material) {}
  [[gnu::always_inline]] V operator()(V heat) const {
    if constexpr (kLatent)
      return L::min(heat, L::max(melting_, L::sub_saturated(heat, latent_)));
    else
      return heat;
  }
  [[gnu::always_inline]] int least_liquid_from() const { return least_liquid_from_; }

 private:
  V melting_, latent_;
  int least_liquid_from_;
};

// Computes floor(((second - first) weight + dither) / 65536) modulo 65536, for |second - first| weight <
// 2^31.
template <class Arch>
class Flux {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;

 public:
  [[gnu::always_inline]] Flux() {}  // to be assigned
  [[gnu::always_inline]] Flux(int weight, std::uint32_t dither)
      : weight_(L::set(weight)), most_(L::set(static_cast<int>(0xFFFF - dither))) {}

  [[gnu::always_inline]] V between(V first, V second) const {
    return L::sub_if(L::less(second, first), flux(second - first), weight_);
  }
  // Computes the flux of pairs only. Other lanes are 0.
  [[gnu::always_inline]] V between(V first, V second, M pair) const {
    return L::sub_if(L::less(second, first) & pair, flux(L::keep(pair, second - first)), weight_);
  }

  // Holds sums of fluxes of one weight: the sum of the differences modulo 65536, and how many of them were
  // negative.
  struct Total {
    V fluxes = L::zero(), negative = L::zero();
  };
  [[gnu::always_inline]] void add(Total& total, V first, V second) const {
    const V difference = second - first;
    total.fluxes = L::carry(total.fluxes + L::high(difference, weight_), L::low(difference, weight_), most_);
    total.negative = L::carry(total.negative, first, second);
  }
  [[gnu::always_inline]] V value(const Total& total) const {
    return total.fluxes - L::low(total.negative, weight_);
  }

  // Returns the flux of a difference that is not negative.
  [[gnu::always_inline]] V falling(V difference) const { return flux(difference); }

 private:
  // Returns the flux of the difference modulo 65536. It is too large by the weight where the true difference
  // is negative.
  [[gnu::always_inline]] V flux(V difference) const {
    return L::carry(L::high(difference, weight_), L::low(difference, weight_), most_);
  }

  V weight_, most_;
};

}  // namespace voxmelt::simd
