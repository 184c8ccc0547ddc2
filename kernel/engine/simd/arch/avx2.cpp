// The kernels for AVX2.
#include "kernel/engine/cpu/lanes_avx2.h"
#include "kernel/engine/simd/arch/arch.h"
#include "kernel/engine/simd/choose_kernels.h"

namespace voxmelt::simd {

Kernels avx2_kernels(const rule::Parameters& parameters) { return kernels_for<xsimd::avx2>(parameters); }

}  // namespace voxmelt::simd
