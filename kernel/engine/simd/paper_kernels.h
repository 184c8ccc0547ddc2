// Each instruction set has the paper law's kernels here, one set per combination of features.
#pragma once

#include <cstdint>

#include "kernel/engine/simd/apply.h"
#include "kernel/engine/simd/gravity.h"
#include "kernel/engine/simd/pattern.h"

namespace voxmelt::simd {

template <class Arch, GravityFeatures kFeatures>
void gravity_row(const View& view, const Step& step, int z, int r, TileRow work, TileRow& follow,
                 TileRow* changed, Books& books) {
  Gravity<Arch, kFeatures>(view, step, z, books).run(r, work, follow, changed);
}

template <class Arch, SpreadFeatures kFeatures>
TileRow pattern_row(const View& view, const Step& step, int z, int r, TileRow work,
                    const std::uint64_t* below, Gifts& gifts) {
  return Pattern<Arch, kFeatures>(view, step, z, below, gifts).run(r, work);
}

template <class Arch, SpreadFeatures kFeatures>
TileRow apply_row(const View& view, const Step& step, int z, int r, const Gifts& below, const Gifts& own,
                  const Gifts& above, Books& books) {
  return Apply<Arch, kFeatures>(view, step, z, below, own, above, books).run(r);
}

template <class Arch, bool kHot>
void choose_paper_kernels(const rule::Parameters& parameters, Kernels& kernels) {
  const rule::Flow& flow = parameters.flow;
  const rule::PaperLaw& law = flow.paper;
  const bool guided = kBuilt.guided && (!flow.fall.is_free() || parameters.freezes() || law.beta != 65536 ||
                                        law.reading == rule::EnergyReading::printed);
  kernels.gravity = guided ? gravity_row<Arch, GravityFeatures{kHot, true}>
                           : gravity_row<Arch, GravityFeatures{kHot, false}>;

  const bool general =
      kBuilt.general && (law.use_table || !law.downhill || law.reading == rule::EnergyReading::printed);
  const bool thermal = kBuilt.thermal && flow.thermal_viscosity;
  const bool support = kBuilt.support && law.support;
  const auto spread = [&]<bool kEight, bool kThermal, bool kGeneral>() {
    kernels.pattern = support ? pattern_row<Arch, SpreadFeatures{kHot, kEight, kThermal, kGeneral, true}>
                              : pattern_row<Arch, SpreadFeatures{kHot, kEight, kThermal, kGeneral, false}>;
    kernels.apply = apply_row<Arch, SpreadFeatures{kHot, kEight, kThermal, kGeneral, false}>;
  };
  const auto with = [&]<bool kThermal, bool kGeneral>() {
    if (kBuilt.eight && law.neighbours == 8)
      spread.template operator()<true, kThermal, kGeneral>();
    else
      spread.template operator()<false, kThermal, kGeneral>();
  };
  if (general && thermal) {
    with.template operator()<true, true>();
  } else if (general) {
    with.template operator()<false, true>();
  } else if (thermal) {
    with.template operator()<true, false>();
  } else {
    with.template operator()<false, false>();
  }
}

}  // namespace voxmelt::simd
