// The closed form tells how long a DRAM takes for the streams of the pipeline. It uses only the numbers of
// the DRAM's sheet and of its controller. It shares nothing with the model of the controller, and holds no
// fitted constant.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/memory/parameters.h"
#include "hwmodel/pipeline/time/stream_work.h"

namespace voxmelt::hwmodel::explore {

// Returns the share of cases in which a stream meets another one, so many bursts behind it, in the same bank
// but in another row.
double meeting(double bursts, const memory::Parameters& parameters);

// Tells how often a turn of the bus finds a bank in use. Then the first burst of the new side needs the bank
// of the other side's last burst, for another row.
struct Meetings {
  double of_writes = 0, of_reads = 0;
};

// Returns the memory's cycles for so many bursts, while reads and writes wait without end.
double burst_cycles(double reads, double writes, const Meetings& meetings,
                    const memory::Parameters& parameters, const memory::Policy& policy = {});

// Tells how far the writes of a pass lie behind its reads.
struct Behind {
  double bursts = 0;
  double share = 1;  // part of the time, 0..1
};

// Counts the bursts of one column. Columns are uneven in irradiance, and with hw.coded also in the state.
struct ColumnBursts {
  double reads = 0, writes = 0;
};
struct ColumnWork {
  // The columns stand in the order of the stream.
  std::vector<ColumnBursts> columns;
  double column_cycles = 0, lag = 0;  // cycles of the machine, without waits
  // `fed` counts the bursts of irradiance that all feeds together fetch in the time of each column, until the
  // pipeline is empty. A feed asks at once for as much as it has used. At the beginning it fills its buffer
  // with `fed_first`.
  std::vector<double> fed{}, fed_first{};
  bool coded = false;
};
// All of these are cycles of the machine.
struct BusTimes {
  double read = 0, write = 0;  // a burst on the bus; the writes bear the turns
  double latency = 0;          // from a read to its data
};
// Before the call, `waits` is false if the pipeline is known never to wait after its first column. The
// function sets it to whether the pipeline waits.
std::int64_t cycles_by_columns(const ColumnWork& work, const BusTimes& times, const memory::Policy& policy,
                               bool& waits);

// Describes how the state lies in the memory. For one even stream both lists are empty: the writes then lie
// as many bursts behind as the lag has.
struct Placement {
  std::vector<Behind> behind{};
  ColumnWork work{};
};

// Returns the cycles of the machine for `work`, which counts as one pass.
std::int64_t cycles_on(const StreamWork& work, const memory::Parameters& parameters, int clock_mhz,
                       const Placement& placement = {}, const memory::Policy& policy = {});
// Returns the same at several clocks, the lowest first. If the pipeline never waits at one clock, it does not
// wait at a lower one either.
std::vector<std::int64_t> cycles_on(const StreamWork& work, const memory::Parameters& parameters,
                                    const std::vector<int>& clocks, const Placement& placement);

}  // namespace voxmelt::hwmodel::explore
