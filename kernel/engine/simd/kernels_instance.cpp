// This file is compiled once for each instruction set.
#include "kernel/engine/cpu/own_lanes.h"
#include "kernel/engine/simd/choose_kernels.h"

namespace voxmelt::simd {

template Kernels kernels_for<cpu::OwnArch>(const rule::Parameters& parameters);

}  // namespace voxmelt::simd
