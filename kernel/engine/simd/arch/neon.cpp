// The kernels for NEON.
#include "kernel/engine/cpu/lanes_neon.h"
#include "kernel/engine/simd/arch/arch.h"
#include "kernel/engine/simd/choose_kernels.h"

namespace voxmelt::simd {

Kernels neon_kernels(const rule::Parameters& parameters) { return kernels_for<xsimd::neon64>(parameters); }

}  // namespace voxmelt::simd
