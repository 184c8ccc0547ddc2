#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/explore/dram_time.h"
#include "hwmodel/machine/column_port.h"

namespace voxmelt::hwmodel::explore {

// The bus serves columns in their order, each as soon as there is room for it; the pipeline takes a column
// when it has come. All times are cycles of the machine.
std::int64_t cycles_by_columns(const ColumnWork& work, const BusTimes& times, const memory::Policy& policy) {
  const std::vector<ColumnBursts>& columns = work.columns;
  const auto ahead = static_cast<std::size_t>(work.coded ? kColumnsAhead : kBurstsAhead);
  const auto lag = static_cast<std::size_t>(std::llround(work.lag / work.column_cycles));
  const auto most = static_cast<double>(kBurstsAhead + policy.writes);  // that wait to be written
  std::vector<double> done(columns.size());                             // when the pipeline has taken it
  double bus = 0, waiting = 0;
  std::int64_t asked = 0;  // bursts, less those of columns before `freed`
  std::size_t freed = 0, written = 0;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    asked += columns[c].reads;
    while (freed < c && asked > kBurstsAhead) asked -= columns[freed++].reads;
    double gate = freed > 0 ? done[freed - 1] : 0;
    if (c >= ahead) gate = std::max(gate, done[c - ahead]);
    const double start = std::max(bus, gate);
    for (; written + lag < c && done[written + lag] <= start; ++written) waiting += columns[written].writes;
    waiting -= std::min(waiting, (start - bus) / times.write);  // while it has nothing to read
    // While both wait, each gets as many; writes that find no room go first.
    const double own = columns[c].reads;
    const double served = std::max(std::min(waiting, own), waiting - most);
    waiting -= served;
    bus = start + (own + work.fed) * times.read + served * times.write;
    // The begin of a coded column tells what else to ask for.
    const double come = std::max(bus, gate + (work.coded ? 2 : 1) * times.latency + own * times.read);
    done[c] = std::max((c > 0 ? done[c - 1] : 0) + work.column_cycles,
                       come + work.column_cycles / std::max(own, 1.0));
  }
  double end = columns.empty() ? 0 : done.back();
  for (double left = work.lag; left > 0; left -= work.column_cycles) {
    const double step = std::min(left, work.column_cycles);
    end += step;
    if (written < columns.size()) waiting += columns[written++].writes;
    waiting -= std::min(waiting, step / times.write);
    if (waiting <= most) continue;
    end += (waiting - most) * times.write;
    waiting = most;
  }
  return std::llround(end);
}

}  // namespace voxmelt::hwmodel::explore
