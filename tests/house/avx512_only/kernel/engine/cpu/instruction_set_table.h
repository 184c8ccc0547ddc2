// The header takes the place of kernel/engine/cpu/instruction_set_table.h for house.avx512. It has AVX-512,
// emulated, and nothing else.
#pragma once

#include <array>
#include <string_view>
#include <tuple>

namespace xsimd {
struct avx512bw;
}

namespace voxmelt::cpu {

enum class InstructionSet { avx512 };
using Architectures = std::tuple<xsimd::avx512bw>;

struct InstructionSetRow {
  InstructionSet set;
  std::string_view name, description;
  bool (*supported)();
};

inline bool emulated() { return true; }

inline constexpr std::array kInstructionSets{
    InstructionSetRow{InstructionSet::avx512, "avx512", "32 lanes of 16 bits, emulated", emulated},
};

}  // namespace voxmelt::cpu
