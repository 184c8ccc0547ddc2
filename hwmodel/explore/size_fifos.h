// The channels get depths with which the machine takes no more cycles than with the deepest channels. None of
// them can be smaller: one token less anywhere costs cycles.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hwmodel/explore/timing.h"
#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel::explore {

struct SizedChannel {
  std::string name;
  int depth = 0, bits = 0, highest = 0;  // highest: the most tokens that it held while it was deep
  std::int64_t one_less = 0;             // cycles that one token less costs; 0 if the depth is 1
};

struct Sizing {
  std::vector<SizedChannel> channels;
  std::int64_t cycles = 0;       // cycles with these depths
  std::int64_t deep_cycles = 0;  // cycles with deep channels: as many, or more on a DRAM
  int runs = 0;                  // simulated runs
};

struct SizingMemory {
  memory::Parameters parameters;
  int clock_mhz = 0;
};

// The depths of `run` do not count. Throws std::runtime_error if the deep machine hangs.
Sizing size_fifos(const TimedRun& run, const std::optional<SizingMemory>& memory);

// Returns a file that --hw reads.
std::string toml_of(const Sizing& sizing, const Configuration& configuration, const std::string& title);

}  // namespace voxmelt::hwmodel::explore
