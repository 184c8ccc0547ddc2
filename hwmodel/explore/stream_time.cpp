#include "hwmodel/explore/stream_time.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "hwmodel/pipeline/streams/column_port.h"

namespace voxmelt::hwmodel::explore {
namespace {

constexpr double kPiece = 16;  // bursts of a column that are weighed at once

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

 private:
  std::vector<double> left_;
};

// Tells when the pipeline had used so many bursts of the state. It is asked for more and more of them.
class Used {
 public:
  void add(double bursts, double cycle) {
    if (bursts > 0) marks_.push_back({marks_.back().bursts + bursts, cycle});
  }
  double when(double bursts) {
    while (marks_.size() > 1 && marks_[1].bursts < bursts) marks_.pop_front();
    const Mark& a = marks_.front();
    if (bursts <= a.bursts || marks_.size() == 1) return a.cycle;
    const Mark& b = marks_[1];
    return a.cycle + (b.cycle - a.cycle) * (bursts - a.bursts) / (b.bursts - a.bursts);
  }

 private:
  struct Mark {
    double bursts = 0, cycle = 0;
  };
  std::deque<Mark> marks_{{}};
};

class StreamTime {
 public:
  StreamTime(const ColumnWork& work, const BusTimes& times, const memory::Policy& policy)
      : work_(work),
        latency_(times.latency),
        held_(times.held),
        ahead_(work.coded ? kColumnsAhead : kBurstsAhead),
        lag_(static_cast<std::size_t>(std::llround(work.lag / work.column_cycles))),
        first_(work.fed_first),
        bus_(times, policy) {
    // A coded column lies in a slot of its own, and there another row may be open.
    if (work.coded) latency_ += times.open * std::min(1.0, work.slot_bursts / times.row_bursts);
  }

  std::int64_t cycles(bool& waits);

 private:
  bool reads(std::size_t column) const { return column < work_.columns.size(); }
  double done_before(std::size_t column, std::size_t by) const {
    return column >= by ? done_[column - by] : 0;
  }
  // Replies come in order. So all wait for those that came right behind a write of their channel.
  double latency() const { return latency_ + (bus_.has_written() ? held_ : 0) + bus_.late(); }
  void take(std::size_t column);
  void begin_coded(std::size_t column);
  void begin_next(std::size_t column);
  // Returns when the buffer has room for so many bursts more of a column, beside the begins of later ones.
  double room(std::size_t column, double bursts) {
    const std::size_t begins = begun_.size() > column ? begun_.size() - column - 1 : 0;
    return used_.when(asked_ + bursts + static_cast<double>(begins) - kBurstsAhead);
  }
  double written_by(std::size_t column);

  const ColumnWork& work_;
  double latency_, held_;
  std::size_t ahead_, lag_;  // columns
  FirstOfFeeds first_;
  BusTime bus_;
  Used used_;
  std::vector<double> done_;   // cycle at which the pipeline has taken each column
  std::vector<double> begun_;  // with hw.coded, the cycle at which the begin of each column has come
  std::size_t written_ = 0;    // columns that the pipeline has handed to the bus
  double asked_ = 0;           // bursts of the state
  double last_ = 0;            // when the pipeline has taken what came so far
  bool waited_ = false;
};

void StreamTime::begin_next(std::size_t column) {
  const double ask = std::max(done_before(begun_.size(), ahead_), room(column, 1));
  begun_.push_back(bus_.read(1, ask) + latency());
}

// The begins of a few columns are read ahead. The first burst of a column tells how many follow. Begins and
// columns share the bus in the order in which they are asked for.
void StreamTime::begin_coded(std::size_t column) {
  while (begun_.size() <= column) begin_next(column);
  const double ask = std::max(begun_[column], room(column, 1));
  const std::size_t end = std::min(column + ahead_, work_.columns.size());
  while (begun_.size() < end && done_before(begun_.size(), ahead_) < ask) begin_next(column);
}

// Returns the bursts of the columns that the pipeline has finished by the time of this one.
double StreamTime::written_by(std::size_t column) {
  double bursts = 0;
  for (; written_ + lag_ < column && done_[written_ + lag_] <= last_; ++written_)
    bursts += work_.columns[written_].writes;
  return bursts;
}

// The pipeline takes a column piece by piece, as it comes. Feeds ask for little, and in turn with the state,
// so they get it at once.
void StreamTime::take(std::size_t column) {
  const double own = reads(column) ? work_.columns[column].reads : 0;
  const double fed = column < work_.fed.size() ? work_.fed[column] : 0;
  const bool coded = work_.coded && reads(column);
  if (coded) begin_coded(column);
  const double pieces = std::max(1.0, std::ceil(own / kPiece)), writes = written_by(column);
  const double gate = !reads(column) ? last_ : coded ? begun_[column] : done_before(column, ahead_);
  const bool all_has_come = coded && own <= 1;
  for (int piece = 0; piece < pieces; ++piece) {
    const double state = own / pieces, rest = state - (coded ? 1 / pieces : 0);
    const double ask = std::max(gate, room(column, 0));
    asked_ += state;
    const double ask_last = std::max(gate, room(column, 0));
    bus_.write(writes / pieces);
    const double passed = bus_.read(rest + fed / pieces + first_.beside(std::max(state, 1 / pieces)), ask);
    const double next = last_ + work_.column_cycles / pieces;
    const double come = all_has_come    ? begun_[column]
                        : reads(column) ? std::max(passed, ask_last) + latency()
                                        : passed;
    // Tokens follow the burst that brings them. A writer that finds no room holds everything.
    const double of_burst = reads(column) ? work_.column_cycles / std::max(1.0, own) : 0;
    last_ = bus_.hold(std::max(next, come + of_burst));
    waited_ = waited_ || (column > 0 && last_ > next);
    used_.add(state, last_);
  }
  done_.push_back(last_);
}

std::int64_t StreamTime::cycles(bool& waits) {
  const std::size_t columns = work_.columns.size() + lag_;
  const double rest_of_lag = work_.lag - static_cast<double>(lag_) * work_.column_cycles;
  const std::size_t pass = work_.pass_columns;
  const auto repeats = static_cast<double>(work_.repeats);
  done_.reserve(columns);
  take(0);
  if (!waits) {
    const double further = static_cast<double>(columns - 1) + repeats * static_cast<double>(pass);
    return std::llround(last_ + work_.column_cycles * further + rest_of_lag);
  }
  while (done_.size() < columns) take(done_.size());
  for (; reads(written_); ++written_) bus_.write(work_.columns[written_].writes);
  waits = waited_ || bus_.overflows();
  const double lap = repeats > 0 ? done_[2 * pass - 1] - done_[pass - 1] : 0;
  return std::llround(bus_.rest(last_) + repeats * lap + rest_of_lag);
}

}  // namespace

std::int64_t cycles_by_columns(const ColumnWork& work, const BusTimes& times, const memory::Policy& policy,
                               bool& waits) {
  return StreamTime(work, times, policy).cycles(waits);
}

}  // namespace voxmelt::hwmodel::explore
