#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/explore/dram_time.h"
#include "hwmodel/memory/ratio.h"
#include "hwmodel/pipeline/streams/column_port.h"

namespace voxmelt::hwmodel::explore {
namespace {

// Keeps what the feeds still have to fetch at the beginning, side by side with bursts of the state.
class FirstOfFeeds {
 public:
  explicit FirstOfFeeds(const std::vector<double>& bursts) : left_(bursts) {}

  double beside(double bursts) {
    if (left_.empty()) return 0;
    double fetched = 0;
    for (double& left : left_) {
      const double some = std::min(left, bursts);
      left -= some;
      fetched += some;
    }
    if (*std::max_element(left_.begin(), left_.end()) <= 0) left_.clear();
    return fetched;
  }
  std::size_t feeds() const { return left_.size(); }

 private:
  std::vector<double> left_;
};

}  // namespace

// The bus serves columns in their order, each as soon as there is room for it. The pipeline takes a column
// when it has come. Feeds ask for little, and in turn with the state, so they get it at once. Hence only the
// state's buffer outlasts a stretch with much irradiance. All times are cycles of the machine.
std::int64_t cycles_by_columns(const ColumnWork& work, const BusTimes& times, const memory::Policy& policy,
                               bool& waits) {
  const std::vector<ColumnBursts>& columns = work.columns;
  const std::size_t ahead = work.coded ? kColumnsAhead : kBurstsAhead;
  const std::size_t lag = std::llround(work.lag / work.column_cycles);
  const double most = kBurstsAhead + policy.writes;             // bursts that may wait to be written
  const double latency = (work.coded ? 2 : 1) * times.latency;  // coded: the first burst tells the rest
  std::vector<double> done(columns.size() + lag);  // cycle at which the pipeline has taken a column
  FirstOfFeeds first(work.fed_first);
  double bus = 0, waiting = 0, last = 0;
  bool waited = false;
  double asked = 0;  // bursts, without those of columns before `freed`
  std::size_t freed = 0, written = 0;
  for (std::size_t c = 0; c < done.size(); ++c) {
    const bool reads = c < columns.size();  // else the pipeline drains
    const double own = reads ? columns[c].reads : 0;
    asked += own;
    while (freed < std::min(c, columns.size()) && asked > kBurstsAhead) asked -= columns[freed++].reads;
    double gate = freed > 0 ? done[freed - 1] : 0;
    if (c >= ahead) gate = std::max(gate, done[c - ahead]);
    const double start = std::max(bus, reads ? gate : last);
    for (; written + lag < c && done[written + lag] <= start; ++written) waiting += columns[written].writes;
    // Writes, and then the feeds, use the bus while there is no state to read.
    const double idle = start - bus, wrote = std::min(waiting, idle / times.write);
    waiting -= wrote;
    if (first.feeds() > 0) first.beside(ratio((idle - wrote * times.write) / times.read, first.feeds()));
    const double fed = (c < work.fed.size() ? work.fed[c] : 0) + first.beside(std::max(own, 1.0));
    // While both wait, each gets as many bursts. Writes that find no room go first.
    const double served = std::max(std::min(waiting, own + fed), waiting - most);
    waiting -= served;
    bus = start + (own + fed) * times.read + served * times.write;
    const double come =
        reads ? std::max(bus, gate + latency + own * times.read) + work.column_cycles / std::max(own, 1.0)
              : bus;
    const double next = last + work.column_cycles;
    done[c] = last = std::max(next, come);
    if (c == 0 && !waits)
      return std::llround(last + work.column_cycles * static_cast<double>(done.size() - 1));
    waited = waited || (c > 0 && last > next);
  }
  for (; written < columns.size(); ++written) waiting += columns[written].writes;
  waits = waited || waiting > most;
  return std::llround(last + std::max(0.0, waiting - most) * times.write);
}

}  // namespace voxmelt::hwmodel::explore
