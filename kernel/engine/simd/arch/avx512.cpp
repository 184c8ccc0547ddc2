// The kernels for AVX-512BW.
#include "kernel/engine/cpu/lanes_avx512.h"
#include "kernel/engine/simd/arch/arch.h"
#include "kernel/engine/simd/choose_kernels.h"

namespace voxmelt::simd {

Kernels avx512_kernels(const rule::Parameters& parameters) {
  return kernels_for<xsimd::avx512bw>(parameters);
}

}  // namespace voxmelt::simd
