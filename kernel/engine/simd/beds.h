// Beds say where the surface of a blocked cell lies, on which liquid stands (docs/automaton.md, section 10).
#pragma once

#include <cstddef>

#include "kernel/engine/cpu/lanes.h"
#include "kernel/engine/simd/kernels.h"

namespace voxmelt::simd {

// A bed is 2048 more than its offset: 4096 is a flat one, and 0 is a cell lower.
inline constexpr int kFlat = 4096;

template <class Arch>
class Beds {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;

 public:
  [[gnu::always_inline]] explicit Beds(const rule::Parameters& parameters)
      : hot_(parameters.heat.enabled),
        liquid_from_(L::set(parameters.material.melting_point + parameters.material.latent_heat)) {
    const int range = parameters.material.latent_heat < 4096 ? 4096 : parameters.material.latent_heat;
    int widened = 1;  // a power of two: the melting range then has 16 bits
    while (range * widened * 2 < 65536) widened *= 2;
    const int whole = range * widened;
    range_ = L::set(range);
    widened_ = L::set(widened);
    scale_ = L::set(((1 << 28) + whole - 1) / whole);
  }

  // Returns the beds below row y.
  [[gnu::always_inline]] V below(const View& view, int w, int y, int z, int part) const {
    if (y == 0) return L::set(kFlat);
    const std::size_t word = view.word(w, y - 1, z);
    const std::size_t at = view.cell(w, y - 1, z) + static_cast<std::size_t>(part * L::kCount);
    const V amount = L::load(view.amount + at), inert = amount + L::set(2048);
    if (!L::in_part(view.solid[word], part)) return inert;
    const V thick = L::min(amount, L::set(6143));
    const V solid = hot_ ? melted(thick, L::load(view.heat + at)) : thick;
    return L::select(L::from_bits(view.solid[word], part), solid, inert);
  }

 private:
  [[gnu::always_inline]] V melted(V thick, V heat) const {
    const V lack = L::min(L::max(liquid_from_, heat) - heat, range_);
    const V left = L::high(L::low(lack, widened_), scale_);  // 4096 is all of it
    return L::high(L::low(thick, L::set(2)), L::low(left, L::set(8)));
  }

  const bool hot_;
  const V liquid_from_;
  V range_, widened_, scale_;
};

}  // namespace voxmelt::simd
