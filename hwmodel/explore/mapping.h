// Every buffer is mapped to a kind of memory. Buffers of the same name have the same kind in every time step
// of the cascade, and in every copy of a stage. All choices are weighed, and those that no other beats are
// kept.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/explore/device.h"

namespace voxmelt::hwmodel::explore {

// Counts what a choice takes. BRAM is counted in parts of a block.
struct MemoryUse {
  std::int64_t lutram = 0, parts = 0, uram = 0;
  friend MemoryUse operator+(const MemoryUse& a, const MemoryUse& b) {
    return {a.lutram + b.lutram, a.parts + b.parts, a.uram + b.uram};
  }
  friend MemoryUse operator*(std::int64_t n, const MemoryUse& a) {
    return {n * a.lutram, n * a.parts, n * a.uram};
  }
};

// Returns the ways to hold `words` of `bits` in memories of a family: LUTs, BRAM, URAM. A way that another
// one beats is among them, too.
std::vector<MemoryUse> ways_to_hold(std::int64_t words, std::int64_t bits, const Family& family);

// Counts the LUTs of a memory of LUTs, with those that choose among its parts.
std::int64_t luts_to_hold(std::int64_t words, std::int64_t bits, const Family& family);

// Returns every sum of one of each, without those that another one beats.
std::vector<MemoryUse> sums_of(const std::vector<MemoryUse>& a, const std::vector<MemoryUse>& b);

}  // namespace voxmelt::hwmodel::explore
