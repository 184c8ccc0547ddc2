#include "kernel/simd/kernels.h"

#include "kernel/simd/arch/arch.h"

namespace voxmelt::simd {

Kernels kernels(cpu::InstructionSet set, const rule::Parameters& parameters) {
  switch (set) {
    case cpu::InstructionSet::sse42:
      return sse42_kernels(parameters);
    case cpu::InstructionSet::avx2:
      return avx2_kernels(parameters);
    case cpu::InstructionSet::avx512:
      return avx512_kernels(parameters);
  }
  return {};
}

}  // namespace voxmelt::simd
