// The kernels for SSE4.2.
#include "kernel/engine/cpu/lanes_sse.h"
#include "kernel/engine/simd/arch/arch.h"
#include "kernel/engine/simd/choose_kernels.h"

namespace voxmelt::simd {

Kernels sse42_kernels(const rule::Parameters& parameters) { return kernels_for<xsimd::sse4_2>(parameters); }

}  // namespace voxmelt::simd
