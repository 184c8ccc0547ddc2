// The paper law's kernels of one instruction set, one set per combination of features.
#pragma once

#include "kernel/simd/apply.h"
#include "kernel/simd/gravity.h"
#include "kernel/simd/pattern.h"

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
  const bool guided = flow.fall.factor != 65536 || flow.fall.wall_factor != 65536 || flow.fall.hang > 0 ||
                      law.beta != 65536 || law.reading == rule::EnergyReading::printed;
  kernels.gravity = guided ? gravity_row<Arch, GravityFeatures{kHot, true}>
                           : gravity_row<Arch, GravityFeatures{kHot, false}>;

  const bool general = law.use_table || !law.downhill || law.reading == rule::EnergyReading::printed;
  const auto spread = [&]<SpreadFeatures kFeatures>() {
    kernels.pattern = pattern_row<Arch, kFeatures>;
    kernels.apply = apply_row<Arch, kFeatures>;
  };
  const auto with = [&]<bool kThermal, bool kGeneral>() {
    if (law.neighbours == 8) {
      spread.template operator()<SpreadFeatures{kHot, true, kThermal, kGeneral}>();
    } else {
      spread.template operator()<SpreadFeatures{kHot, false, kThermal, kGeneral}>();
    }
  };
  if (general && flow.thermal_viscosity) {
    with.template operator()<true, true>();
  } else if (general) {
    with.template operator()<false, true>();
  } else if (flow.thermal_viscosity) {
    with.template operator()<true, false>();
  } else {
    with.template operator()<false, false>();
  }
}

}  // namespace voxmelt::simd
