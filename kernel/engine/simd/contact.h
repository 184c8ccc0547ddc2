// The friction of a cell depends on the matter below it (Eqs. 16-20).
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/lanes.h"
#include "kernel/engine/simd/kernels.h"

namespace voxmelt::simd {

// Returns the alpha of the cells of vector `part` of mask word `word`. With `floor` they are the lowest of
// the grid.
template <class Arch>
VOXMELT_LANES typename cpu::Lanes<Arch>::V contact_alpha(const View& view, const rule::PaperLaw& law,
                                                         bool floor, std::size_t word, int part) {
  using L = cpu::Lanes<Arch>;
  if (floor) return L::set(law.alpha_floor);
  const std::size_t below = word - view.words;
  const std::uint64_t solid = view.solid[below], inert = view.inert[below];
  if ((solid | inert) == 0) return L::set(law.alpha_liquid);
  const auto on_solid =
      L::select(L::from_bits(solid, part), L::set(law.alpha_solid), L::set(law.alpha_liquid));
  return L::select(L::from_bits(inert, part), L::set(law.alpha_floor), on_solid);
}

}  // namespace voxmelt::simd
