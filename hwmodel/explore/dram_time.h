// The closed form tells how long a DRAM takes for the streams of the pipeline. It uses only the numbers of
// the DRAM's sheet and of its controller. It shares nothing with the model of the controller, and holds no
// fitted constant.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hwmodel/explore/stream_time.h"
#include "hwmodel/memory/parameters.h"
#include "hwmodel/pipeline/time/stream_work.h"

namespace voxmelt::hwmodel::explore {

// Returns the share of cases in which a stream meets another one, so many bursts behind it, in the same bank
// but in another row.
double meeting(double bursts, const memory::Parameters& parameters);

// Tells how far the writes of a pass lie behind its reads.
struct Behind {
  double bursts = 0;
  double share = 1;  // part of the time, 0..1
};

// Describes how the state lies in the memory. If `behind` is empty, the writes lie as many bursts behind as
// the lag has. If there are no columns, nobody knows what lies there, and nothing waits.
struct Placement {
  std::vector<Behind> behind{};
  ColumnWork work{};
};

// The closed form is within this share of the simulated cycles, and within the time of one refresh. The test
// `DrawnMemories` compares it where no number exceeds these.
inline constexpr double kBound = 0.05;
inline constexpr int kMostNanoseconds = 400;                // on the way through controller and pins
inline constexpr int kMostChannels = 32, kMostClock = 500;  // MHz of the machine
// Says what exceeds them, such as "64 channels (at most 32)". Empty: nothing.
std::string beyond_bounds(const memory::Parameters& parameters, int clock_mhz);
// Returns the cycles by which the closed form may be off.
std::int64_t allowed_error(std::int64_t cycles, const memory::Parameters& parameters, int clock_mhz);

// Returns the cycles of the machine for `work`, which counts as one pass.
std::int64_t cycles_on(const StreamWork& work, const memory::Parameters& parameters, int clock_mhz,
                       const Placement& placement = {}, const memory::Policy& policy = {});
// Returns the same at several clocks, the lowest first. If the pipeline never waits at one clock, it does not
// wait at a lower one either.
std::vector<std::int64_t> cycles_on(const StreamWork& work, const memory::Parameters& parameters,
                                    const std::vector<int>& clocks, const Placement& placement);

}  // namespace voxmelt::hwmodel::explore
