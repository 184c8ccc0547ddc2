// A hundred million commands break no rule of a sheet.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "hwmodel/memory/dram.h"
#include "hwmodel/memory/timing_checker.h"
#include "tests/hwmodel/memory/memory_traffic.h"

namespace voxmelt::hwmodel::memory {
namespace {

TEST(MemoryLong, AHundredMillionCommandsKeepTheRules) {
  std::int64_t commands = 0;
  for (std::uint64_t seed = 0; commands < 100'000'000; ++seed) {
    std::vector<Parameters> all = all_sheets();
    all.push_back(two_ranks());
    for (const Parameters& p : all_by_bank()) all.push_back(p);
    for (const Parameters& p : all) {
      Dram dram(p, seed % 2 == 0 ? 200 : 400);
      TimingChecker checker(p);
      dram.listen(&checker);
      Traffic traffic(dram, 1 + static_cast<int>(seed % 5), seed);
      traffic.run(4'000'000);
      ASSERT_TRUE(traffic.drain());
      checker.finish(dram.memory_cycles());
      ASSERT_EQ(checker.violations(), 0) << p.name << " seed " << seed << ": " << checker.first();
      commands += checker.commands();
    }
  }
}

}  // namespace
}  // namespace voxmelt::hwmodel::memory
