// One test per instruction set that this processor has.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "kernel/cpu/instruction_set.h"
#include "tests/kernel/cpu/lane_operations.h"

namespace voxmelt::cpu {

template <std::size_t size>
struct alignas(64) Row : std::array<std::uint16_t, size> {};

class LanesTest : public testing::TestWithParam<InstructionSetName> {
 protected:
  void SetUp() override {
    if (!supported(GetParam().set)) GTEST_SKIP() << "not on this processor";
    switch (GetParam().set) {
      case InstructionSet::sse42:
        own_ = sse_operations();
        break;
      case InstructionSet::avx2:
        own_ = avx2_operations();
        break;
      case InstructionSet::avx512:
        own_ = avx512_operations();
        break;
    }
  }

  Operations own_{};
};

inline std::string test_name(const testing::TestParamInfo<InstructionSetName>& info) {
  return std::array{"sse42", "avx2", "avx512"}[static_cast<std::size_t>(info.param.set)];
}

}  // namespace voxmelt::cpu
