// The pipeline waits for what a DRAM brings. It asks ahead as far as its buffer has room, and what it asks
// for takes a while: more bytes than the buffer holds are never under way. So the latency bounds the speed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/explore/bus_time.h"

namespace voxmelt::hwmodel::explore {

// Counts the bursts of one column. Columns are uneven in irradiance, and with hw.coded also in the state.
struct ColumnBursts {
  double reads = 0, writes = 0;
};
struct ColumnWork {
  // The columns stand in the order of the stream. If the train has many passes, they are those of the first,
  // the second and the last one. The second stands for `repeats` more.
  std::vector<ColumnBursts> columns;
  std::size_t pass_columns = 0;
  std::int64_t repeats = 0;
  double column_cycles = 0, lag = 0;  // cycles of the machine, without waits
  // `fed` counts the bursts of irradiance that all feeds together fetch in the time of each column, until the
  // pipeline is empty. A feed asks at once for as much as it has used. At the beginning it fills its buffer
  // with `fed_first`.
  std::vector<double> fed{}, fed_first{};
  bool coded = false;
  double slot_bursts = 0;  // from a column to the next one, with hw.coded
};

// Returns the cycles of the machine. Before the call, `waits` is false if the pipeline is known never to wait
// after its first burst. The function sets it to whether the pipeline waits.
std::int64_t cycles_by_columns(const ColumnWork& work, const BusTimes& times, const memory::Policy& policy,
                               bool& waits);

}  // namespace voxmelt::hwmodel::explore
