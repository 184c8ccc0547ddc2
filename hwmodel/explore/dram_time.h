// How long a DRAM takes for the streams of the pipeline, from the numbers of its sheet and of its controller
// alone. It shares nothing with the model of the controller, and holds no fitted constant.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/memory/parameters.h"
#include "hwmodel/pipeline/time/stream_work.h"

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

// Columns are uneven: with hw.coded the state, and irradiance anyway. In the order of the stream, bursts.
struct ColumnBursts {
  double reads = 0, writes = 0;
};
struct ColumnWork {
  std::vector<ColumnBursts> columns;
  double column_cycles = 0, lag = 0;  // of the machine, without waits
  // Irradiance. A feed asks at once for as much as it has used: in the time of each column, of all feeds
  // together, until the pipeline is empty. At the begin it fills its buffer.
  std::vector<double> fed{}, fed_first{};
  bool coded = false;
};
// Cycles of the machine.
struct BusTimes {
  double read = 0, write = 0;  // a burst on the bus; the writes bear the turns
  double latency = 0;          // of a read
};
// `waits`: false if the pipeline is known never to wait behind its first column. It says whether it does.
std::int64_t cycles_by_columns(const ColumnWork& work, const BusTimes& times, const memory::Policy& policy,
                               bool& waits);

// How the state lies there, unless it is one stream: no columns, and as many bursts behind as the lag has.
struct Placement {
  std::vector<Behind> behind{};
  ColumnWork work{};
};

// Cycles of the machine for one pass of the twin.
std::int64_t cycles_on(const StreamWork& work, const memory::Parameters& parameters, int clock_mhz,
                       const Placement& placement = {}, const memory::Policy& policy = {});
// At several clocks, the lowest first. Where the pipeline never waits, it does not at a lower clock either.
std::vector<std::int64_t> cycles_on(const StreamWork& work, const memory::Parameters& parameters,
                                    const std::vector<int>& clocks, const Placement& placement);

}  // namespace voxmelt::hwmodel::explore
