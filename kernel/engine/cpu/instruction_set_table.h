// Kernels are compiled for these instruction sets. Each row has a name, a description, and a test of the
// processor. The compiler's options stand in cmake/InstructionSets.cmake, the lanes in lanes_<enumerator>.h.
#pragma once

#include <array>
#include <string_view>
#include <tuple>

namespace xsimd {  // lanes.h includes their definitions
struct sse4_2;
struct avx2;
struct avx512bw;
struct neon64;
}  // namespace xsimd

namespace voxmelt::cpu {

// The narrowest comes first. A build for the machine at hand has only one, set by VOXMELT_ONLY_<enumerator>.
#if defined(__aarch64__)
enum class InstructionSet { neon };
using Architectures = std::tuple<xsimd::neon64>;
#elif defined(VOXMELT_ONLY_sse42)
enum class InstructionSet { sse42 };
using Architectures = std::tuple<xsimd::sse4_2>;
#elif defined(VOXMELT_ONLY_avx2)
enum class InstructionSet { avx2 };
using Architectures = std::tuple<xsimd::avx2>;
#else
enum class InstructionSet { sse42, avx2, avx512 };
using Architectures = std::tuple<xsimd::sse4_2, xsimd::avx2, xsimd::avx512bw>;
#endif

struct InstructionSetRow {
  InstructionSet set;
  std::string_view name, description;
  // Tells if this processor has everything that the compiler may use, and if the operating system saves its
  // registers.
  bool (*supported)();
};

#if defined(__aarch64__)
inline bool has_neon() { return true; }  // every 64-bit ARM processor has it

inline constexpr std::array kInstructionSets{
    InstructionSetRow{InstructionSet::neon, "neon", "8 lanes of 16 bits", has_neon},
};
#else
inline bool has_sse42() {  // x86-64-v2
  return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("ssse3") &&
         __builtin_cpu_supports("popcnt");
}
inline bool has_avx2() {  // x86-64-v3
  return has_sse42() && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
         __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
}
inline bool has_avx512() {  // x86-64-v4
  return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
}

inline constexpr std::array kInstructionSets {
#if !defined(VOXMELT_ONLY_avx2)
  InstructionSetRow{InstructionSet::sse42, "sse4.2", "8 lanes of 16 bits", has_sse42},
#endif
#if !defined(VOXMELT_ONLY_sse42)
      InstructionSetRow{InstructionSet::avx2, "avx2", "16 lanes of 16 bits", has_avx2},
#endif
#if !defined(VOXMELT_ONLY_sse42) && !defined(VOXMELT_ONLY_avx2)
      InstructionSetRow{InstructionSet::avx512, "avx512", "32 lanes of 16 bits", has_avx512},
#endif
};
#endif

// Is enough for loops that gain nothing from more lanes than those of AVX2.
inline constexpr InstructionSet kWideEnough{kInstructionSets.size() > 1 ? 1 : 0};

}  // namespace voxmelt::cpu
