// The paper law's kernels of one instruction set, one set per combination of features.
#pragma once

#include "kernel/simd/apply.h"
#include "kernel/simd/gravity.h"
#include "kernel/simd/pattern.h"

namespace voxmelt::simd {

template <class Arch, GravityFeatures kFeatures>
void gravity_slice(const View& view, const Step& step, int z, const TileRow* tiles, TileRow* changed,
                   Books& books) {
  Gravity<Arch, kFeatures>(view, step, z, books).run(tiles, changed);
}

template <class Arch, SpreadFeatures kFeatures>
void pattern_slice(const View& view, const Step& step, int z, const TileRow* tiles, TileRow* restless,
                   Gifts& gifts) {
  Pattern<Arch, kFeatures> pattern(view, step, z, gifts);
  for (int y = 0; y < view.ny; ++y)
    restless[y >> view.tile_shift] |= pattern.row(y, tiles[y >> view.tile_shift]);
}

template <class Arch, SpreadFeatures kFeatures>
void apply_slice(const View& view, const Step& step, int z, const Gifts& below, const Gifts& own,
                 const Gifts& above, TileRow* changed, Books& books) {
  Apply<Arch, kFeatures> apply(view, step, z, below, own, above, books);
  for (int y = 0; y < view.ny; ++y) changed[y >> view.tile_shift] |= apply.row(y);
}

template <class Arch, bool kHot>
void choose_paper_kernels(const rule::Parameters& parameters, Kernels& kernels) {
  const rule::Flow& flow = parameters.flow;
  const rule::PaperLaw& law = flow.paper;
  const bool guided = flow.fall.factor != 65536 || flow.fall.wall_factor != 65536 || flow.fall.hang > 0 ||
                      law.beta != 65536 || law.reading == rule::EnergyReading::printed;
  kernels.gravity = guided ? gravity_slice<Arch, GravityFeatures{kHot, true}>
                           : gravity_slice<Arch, GravityFeatures{kHot, false}>;

  const bool general =
      law.use_table || !law.downhill || flow.thermal_viscosity || law.reading == rule::EnergyReading::printed;
  const auto spread = [&]<bool kEight, bool kGeneral>() {
    constexpr SpreadFeatures features{kHot, kEight, kGeneral};
    kernels.pattern = pattern_slice<Arch, features>;
    kernels.apply = apply_slice<Arch, features>;
  };
  if (law.neighbours == 8) {
    if (general)
      spread.template operator()<true, true>();
    else
      spread.template operator()<true, false>();
  } else {
    if (general)
      spread.template operator()<false, true>();
    else
      spread.template operator()<false, false>();
  }
}

template <class Arch>
Kernels kernels_for(const rule::Parameters& parameters) {
  Kernels kernels;
  if (parameters.heat.enabled)
    choose_paper_kernels<Arch, true>(parameters, kernels);
  else
    choose_paper_kernels<Arch, false>(parameters, kernels);
  return kernels;
}

}  // namespace voxmelt::simd
