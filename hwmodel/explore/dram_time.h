// How long a DRAM takes for the streams of the pipeline, from the numbers of its sheet and of its controller
// alone. It shares nothing with the model of the controller, and holds no fitted constant.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/machine/stream_twin.h"
#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel::explore {

// In which part of all cases does a stream meet another one, so many bursts behind it, in a bank, in another
// row?
double meeting(double bursts, const memory::Parameters& parameters);

// When the bus turns: how often the first burst of the side that comes needs the bank that the last burst of
// the other side has used, for another row.
struct Meetings {
  double of_writes = 0, of_reads = 0;
};

// Cycles of the memory for so many bursts, while reads and writes wait without end.
double burst_cycles(double reads, double writes, const Meetings& meetings,
                    const memory::Parameters& parameters, const memory::Policy& policy = {});

// Where the writes of a pass lie behind its reads.
struct Behind {
  double bursts = 0;
  double share = 1;  // of the time
};

// Cycles of the machine for one pass of the twin. `behind`: empty: as many bursts as its lag has.
std::int64_t cycles_on(const StreamWork& work, const memory::Parameters& parameters, int clock_mhz,
                       const std::vector<Behind>& behind = {}, const memory::Policy& policy = {});

}  // namespace voxmelt::hwmodel::explore
