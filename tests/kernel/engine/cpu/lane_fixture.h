// Runs a test once per instruction set that this processor has.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "kernel/engine/cpu/instruction_set.h"
#include "tests/kernel/engine/cpu/lane_operations.h"

namespace voxmelt::cpu {

template <std::size_t size>
struct alignas(64) Row : std::array<std::uint16_t, size> {};

class LanesTest : public testing::TestWithParam<InstructionSetRow> {
 protected:
  void SetUp() override {
    if (!GetParam().supported()) GTEST_SKIP() << "not on this processor";
    for_each_instruction_set([this]<InstructionSet kSet>() {
      if (kSet == GetParam().set) own_ = operations_for<ArchOf<kSet>>();
    });
  }

  Operations own_{};
};

inline std::string test_name(const testing::TestParamInfo<InstructionSetRow>& info) {
  std::string name(info.param.name);
  std::erase(name, '.');
  return name;
}

}  // namespace voxmelt::cpu
