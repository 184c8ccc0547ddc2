// One object per instruction set: each holds its own copy of everything it needs, and shares nothing but
// these.
#pragma once

#include "kernel/engine/simd/kernels.h"

namespace voxmelt::simd {

Kernels sse42_kernels(const rule::Parameters& parameters);
Kernels avx2_kernels(const rule::Parameters& parameters);
Kernels avx512_kernels(const rule::Parameters& parameters);
Kernels neon_kernels(const rule::Parameters& parameters);

}  // namespace voxmelt::simd
