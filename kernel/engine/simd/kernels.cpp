#include "kernel/engine/simd/kernels.h"

namespace voxmelt::simd {

Kernels kernels(cpu::InstructionSet set, const rule::Parameters& parameters) {
  Kernels found;
  cpu::for_each_instruction_set([&]<cpu::InstructionSet kSet>() {
    if (kSet == set) found = kernels_for<cpu::ArchOf<kSet>>(parameters);
  });
  return found;
}

}  // namespace voxmelt::simd
