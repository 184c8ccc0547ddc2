// One test per instruction set that this processor has.
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

class LanesTest : public testing::TestWithParam<InstructionSetName> {
 protected:
  void SetUp() override {
    if (!supported(GetParam().set)) GTEST_SKIP() << "not on this processor";
#if defined(__aarch64__)
    own_ = neon_operations();
#else
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
      case InstructionSet::neon:
        break;
    }
#endif
  }

  Operations own_{};
};

inline std::string test_name(const testing::TestParamInfo<InstructionSetName>& info) {
  std::string name(info.param.name);
  std::erase(name, '.');
  return name;
}

}  // namespace voxmelt::cpu
