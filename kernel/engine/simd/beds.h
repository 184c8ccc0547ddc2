// Beds say where the surface of a blocked cell lies, on which liquid stands (docs/automaton.md, section 10).
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/lanes.h"
#include "kernel/engine/simd/kernels.h"
#include "kernel/engine/simd/material_lanes.h"

namespace voxmelt::simd {

// A bed is 2048 more than its offset: 4096 is a flat one, and 0 is a cell lower.
inline constexpr int kFlat = 4096;

template <class Arch>
class Beds {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;

 public:
  [[gnu::always_inline]] explicit Beds(const rule::Parameters& parameters)
      : hot_(parameters.heat.enabled), first_(melting_of(parameters.material.latent_heat)) {
    liquid_from_ = L::set(parameters.material.melting_point + parameters.material.latent_heat);
    range_ = L::set(first_.range);
    widened_ = L::set(first_.widened);
    scale_ = L::set(first_.scale);
    if (!parameters.has_materials()) return;
    const Palette palette(parameters);
    for (std::size_t m = 0; m < parameters.materials.size(); ++m) {
      const Melting melting = melting_of(parameters.materials[m].latent_heat);
      liquid_froms_[m] = palette.liquid_from[m];
      ranges_[m] = static_cast<std::uint16_t>(melting.range);
      wideneds_[m] = static_cast<std::uint16_t>(melting.widened);
      scales_[m] = static_cast<std::uint16_t>(melting.scale);
    }
  }

  // Returns the beds below row y.
  [[gnu::always_inline]] V below(const View& view, int w, int y, int z, int part) const {
    if (y == 0) return L::set(kFlat);
    const std::size_t word = view.word(w, y - 1, z);
    const std::size_t at = view.cell(w, y - 1, z) + static_cast<std::size_t>(part * L::kCount);
    const V amount = L::load(view.amount + at), inert = amount + L::set(2048);
    if (!L::in_part(view.solid[word], part)) return inert;
    const V thick = L::min(amount, L::set(6143));
    const V solid = hot_ ? melted(thick, L::load(view.heat + at), view.material, at) : thick;
    return L::select(L::from_bits(view.solid[word], part), solid, inert);
  }

 private:
  // The heat over which a material melts is `range`, and `widened` times that has 16 bits.
  struct Melting {
    int range, widened, scale;
  };
  [[gnu::always_inline]] static Melting melting_of(int latent_heat) {
    const int range = latent_heat < 4096 ? 4096 : latent_heat;
    int widened = 1;
    while (range * widened * 2 < 65536) widened *= 2;
    const int whole = range * widened;
    return {range, widened, ((1 << 28) + whole - 1) / whole};
  }

  [[gnu::always_inline]] V melted(V thick, V heat, const std::uint8_t* materials, std::size_t at) const {
    if (materials == nullptr) return melted(thick, heat, liquid_from_, range_, widened_, scale_);
    const MaterialLanes<Arch> lanes(materials + at);
    return melted(thick, heat, lanes.of(liquid_froms_), lanes.of(ranges_), lanes.of(wideneds_),
                  lanes.of(scales_));
  }
  [[gnu::always_inline]] static V melted(V thick, V heat, V liquid_from, V range, V widened, V scale) {
    const V lack = L::min(L::max(liquid_from, heat) - heat, range);
    const V left = L::high(L::low(lack, widened), scale);  // 4096 is all of it
    return L::high(L::low(thick, L::set(2)), L::low(left, L::set(8)));
  }

  const bool hot_;
  const Melting first_;
  V liquid_from_, range_, widened_, scale_;
  // The same by material, if there are several.
  std::uint16_t liquid_froms_[Palette::kMost] = {}, ranges_[Palette::kMost] = {},
                wideneds_[Palette::kMost] = {}, scales_[Palette::kMost] = {};
};

}  // namespace voxmelt::simd
