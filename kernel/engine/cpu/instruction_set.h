// The instruction sets are listed, and code that was compiled for one of them is called through this header.
#pragma once

#include <cstddef>
#include <string_view>
#include <tuple>
#include <utility>

#include "kernel/engine/cpu/instruction_set_table.h"

namespace voxmelt::cpu {

constexpr const InstructionSetRow& row_of(InstructionSet set) {
  return kInstructionSets[static_cast<std::size_t>(set)];
}
constexpr std::string_view name_of(InstructionSet set) { return row_of(set).name; }
inline bool supported(InstructionSet set) { return row_of(set).supported(); }

// Returns the best one that this processor has.
inline InstructionSet widest() {
  InstructionSet best{};
  for (const InstructionSetRow& row : kInstructionSets)
    if (row.supported()) best = row.set;
  return best;
}

// Is the type that templates are compiled for.
template <InstructionSet kSet>
using ArchOf = std::tuple_element_t<static_cast<std::size_t>(kSet), Architectures>;

// Calls f<set>() for every instruction set, the narrowest first.
template <class F>
void for_each_instruction_set(const F& f) {
  static_assert(kInstructionSets.size() == std::tuple_size_v<Architectures>);
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    static_assert(((kInstructionSets[i].set == InstructionSet{i}) && ...),
                  "rows in the order of InstructionSet");
    (f.template operator()<InstructionSet{i}>(), ...);
  }
  (std::make_index_sequence<kInstructionSets.size()>{});
}

}  // namespace voxmelt::cpu
