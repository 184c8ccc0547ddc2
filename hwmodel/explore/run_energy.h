// The energy of a run by closed forms: what its tokens take in the stages, and what its bursts take in the
// DRAM. The first is exact for what it counts. The second takes rows to be opened once for each stretch of a
// stream, and always to be open.
#pragma once

#include <cstdint>

#include "hwmodel/explore/part_list.h"
#include "hwmodel/explore/schedule.h"
#include "hwmodel/memory/counts.h"
#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel::explore {

// Both are picojoules.
struct RunEnergy {
  double operations = 0;
  double memory = 0;  // 0 for a sheet without currents
  double all() const { return operations + memory; }
  RunEnergy& operator+=(const RunEnergy& more);
};
RunEnergy operator*(double times, const RunEnergy& energy);

// Returns what stages, reader and writer take for all tokens of a train. Where a token only passes by, it
// takes nothing.
double energy_of_tokens(const Train& train, const PartList& parts, bool coded);

// Returns what a DRAM does for a train that takes so many cycles of the machine on it.
memory::Counts counts_of(const StreamWork& work, std::int64_t cycles, int clock_mhz,
                         const memory::Parameters& parameters);

}  // namespace voxmelt::hwmodel::explore
