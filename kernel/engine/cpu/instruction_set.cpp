#include "kernel/engine/cpu/instruction_set.h"

namespace voxmelt::cpu {

bool supported(InstructionSet set) {
#if defined(__x86_64__)
  __builtin_cpu_init();
  switch (set) {
    case InstructionSet::sse42:
      return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("ssse3") &&
             __builtin_cpu_supports("popcnt");
    case InstructionSet::avx2:
      return supported(InstructionSet::sse42) && __builtin_cpu_supports("avx2") &&
             __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
    case InstructionSet::avx512:
      return supported(InstructionSet::avx2) && __builtin_cpu_supports("avx512f") &&
             __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
             __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
    case InstructionSet::neon:
      return false;
  }
  return false;
#elif defined(__aarch64__)
  return set == InstructionSet::neon;  // every such processor has it
#else
  static_cast<void>(set);
  return false;
#endif
}

}  // namespace voxmelt::cpu
