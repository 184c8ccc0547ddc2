// A scene gets only the kernels that it needs.
#pragma once

#include "kernel/engine/simd/heat_kernels.h"
#include "kernel/engine/simd/paper_kernels.h"
#include "kernel/engine/simd/viscous_kernels.h"

namespace voxmelt::simd {

template <class Arch>
Kernels kernels_for(const rule::Parameters& parameters) {
  Kernels kernels;
  choose_heat_kernels<Arch>(parameters, kernels);
  if (kBuilt.viscous && parameters.flow.law == rule::Law::viscous)
    choose_viscous_kernels<Arch>(parameters, kernels);
  else if (kBuilt.heat && parameters.heat.enabled)
    choose_paper_kernels<Arch, true>(parameters, kernels);
  else
    choose_paper_kernels<Arch, false>(parameters, kernels);
  return kernels;
}

}  // namespace voxmelt::simd
