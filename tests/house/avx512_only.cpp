// For house.avx512, in place of kernel/engine/cpu/instruction_set.cpp and the other instruction sets'
// objects: AVX-512, emulated, and nothing else.
#include "kernel/engine/cpu/instruction_set.h"
#include "kernel/engine/simd/arch/arch.h"
#include "tests/kernel/engine/cpu/lane_operations.h"

namespace voxmelt {
namespace cpu {

bool supported(InstructionSet set) { return set == InstructionSet::avx512; }
Operations sse_operations() { __builtin_trap(); }
Operations avx2_operations() { __builtin_trap(); }

}  // namespace cpu

namespace simd {

Kernels sse42_kernels(const rule::Parameters&) { __builtin_trap(); }
Kernels avx2_kernels(const rule::Parameters&) { __builtin_trap(); }

}  // namespace simd
}  // namespace voxmelt
