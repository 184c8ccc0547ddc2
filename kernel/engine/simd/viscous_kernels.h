// Each instruction set has the viscous law's kernels here, one set per combination of features.
#pragma once

#include "kernel/engine/simd/fall.h"
#include "kernel/engine/simd/relax.h"
#include "kernel/engine/simd/settle.h"
#include "kernel/engine/simd/viscous_carry.h"
#include "kernel/engine/simd/viscous_spread.h"

namespace voxmelt::simd {

template <class Arch, ViscousFeatures kFeatures>
void settle_slice(const View& view, const Step& step, int z, const TileRow* tiles, Runs& runs, void* scratch,
                  TileRow* changed, Books& books) {
  Settle<Arch, kFeatures>(view, step, z, runs, scratch, books).run(tiles, changed);
}

template <class Arch, ViscousFeatures kFeatures>
void exchange_pairs_slice(const View& view, const Step& step, int z, const TileRow* tiles, const Runs& runs,
                          TileRow* restless, Currents& currents) {
  ExchangePairs<Arch, kFeatures> exchange(view, step, z, runs, currents);
  for (int y = 0; y < view.ny; ++y)
    restless[y >> view.tile_shift] |= exchange.row(y, tiles[y >> view.tile_shift]);
}

template <class Arch>
void relax_layer(const View& view, const Step& step, int y, const Runs& runs, const RelaxMemory& memory) {
  RelaxLayer<Arch>(view, step, y, runs, memory).run();
}

template <class Arch, ViscousFeatures kFeatures>
void carry_slice(const View& view, const Step& step, int z, const Currents& below, const Currents& own,
                 TileRow* changed, Books& books) {
  Carry<Arch, kFeatures> carry(view, step, z, below, own, books);
  for (int y = 0; y < view.ny; ++y) changed[y >> view.tile_shift] |= carry.row(y);
}

template <class Arch, ViscousFeatures kFeatures>
void fall_slice(const View& view, const Step& step, int z, const TileRow* tiles, const Runs& runs,
                TileRow* changed, Books& books) {
  FallOutside<Arch, kFeatures>(view, step, z, runs, books).run(tiles, changed);
}

template <class Arch>
void choose_viscous_kernels(const rule::Parameters& parameters, Kernels& kernels) {
  const bool guided = kBuilt.guided && !parameters.flow.fall.is_free();
  const auto choose = [&]<bool kHot>() {
    constexpr ViscousFeatures plain{kHot, false}, all{kHot, true}, relaxed{kHot, false, true};
    kernels.settle = settle_slice<Arch, plain>;
    kernels.exchange_pairs = exchange_pairs_slice<Arch, plain>;
    kernels.exchange_relaxed = exchange_pairs_slice<Arch, relaxed>;
    kernels.carry = carry_slice<Arch, plain>;
    kernels.fall = guided ? fall_slice<Arch, all> : fall_slice<Arch, plain>;
  };
  if (kBuilt.heat && parameters.heat.enabled)
    choose.template operator()<true>();
  else
    choose.template operator()<false>();
  kernels.relax = relax_layer<Arch>;
}

}  // namespace voxmelt::simd
