// How long a DRAM takes for the streams of the pipeline, from the numbers of its sheet and of its controller
// alone. It shares nothing with the model of the controller, and holds no fitted constant.
#pragma once

#include <cstdint>

#include "hwmodel/machine/stream_twin.h"
#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel::explore {

// Cycles of the memory for so many bursts, while reads and writes wait without end.
double burst_cycles(double reads, double writes, const memory::Parameters& parameters,
                    const memory::Policy& policy = {});

// Cycles of the machine for one pass of the twin.
std::int64_t cycles_on(const StreamWork& work, const memory::Parameters& parameters, int clock_mhz,
                       const memory::Policy& policy = {});

}  // namespace voxmelt::hwmodel::explore
