// Which of our instruction sets this processor has.
#pragma once

#include <array>
#include <string_view>

namespace voxmelt::cpu {

enum class InstructionSet { sse42, avx2, avx512 };  // x86-64-v2, -v3, -v4

struct InstructionSetName {
  InstructionSet set;
  std::string_view name;
};
inline constexpr std::array<InstructionSetName, 3> kInstructionSets{
    {{InstructionSet::sse42, "sse4.2"}, {InstructionSet::avx2, "avx2"}, {InstructionSet::avx512, "avx512"}}};

// Everything that the compiler may use for that set, and that the operating system keeps its registers.
bool supported(InstructionSet set);

}  // namespace voxmelt::cpu
