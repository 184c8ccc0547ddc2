// Which of our instruction sets this processor has.
#pragma once

#include <array>
#include <string_view>

namespace voxmelt::cpu {

enum class InstructionSet { sse42, avx2, avx512, neon };  // x86-64-v2, -v3, -v4; 64-bit ARM

struct InstructionSetName {
  InstructionSet set;
  std::string_view name;
};
// Those that we are built for, the widest last.
#if defined(__aarch64__)
inline constexpr std::array<InstructionSetName, 1> kInstructionSets{{{InstructionSet::neon, "neon"}}};
#else
inline constexpr std::array<InstructionSetName, 3> kInstructionSets{
    {{InstructionSet::sse42, "sse4.2"}, {InstructionSet::avx2, "avx2"}, {InstructionSet::avx512, "avx512"}}};
#endif

// Everything that the compiler may use for that set, and that the operating system keeps its registers.
bool supported(InstructionSet set);

}  // namespace voxmelt::cpu
