#include "kernel/engine/simd/kernels.h"

#include "kernel/engine/simd/arch/arch.h"

namespace voxmelt::simd {

Kernels kernels(cpu::InstructionSet set, const rule::Parameters& parameters) {
#if defined(__aarch64__)
  if (set == cpu::InstructionSet::neon) return neon_kernels(parameters);
#else
  switch (set) {
    case cpu::InstructionSet::sse42:
      return sse42_kernels(parameters);
    case cpu::InstructionSet::avx2:
      return avx2_kernels(parameters);
    case cpu::InstructionSet::avx512:
      return avx512_kernels(parameters);
    case cpu::InstructionSet::neon:
      break;
  }
#endif
  return {};
}

}  // namespace voxmelt::simd
