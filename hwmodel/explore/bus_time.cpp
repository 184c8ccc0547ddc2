#include "hwmodel/explore/bus_time.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "hwmodel/memory/ratio.h"
#include "hwmodel/pipeline/streams/column_port.h"

namespace voxmelt::hwmodel::explore {

BusTimes bus_times(const memory::Parameters& p, int clock_mhz, double turn) {
  // A machine sees in its next cycle what has come, and asks in the one after it. Parts of cycles are lost.
  constexpr double kOfMachine = 2.5;
  const double clocks = ratio(clock_mhz, p.mhz);
  const std::int64_t row = p.row_bytes() / memory::kBurst * p.groups * p.channels;
  BusTimes times;
  times.burst = clocks * p.beats() * p.columns_of_request() / p.channels;
  times.turn = clocks * turn;
  times.latency = kOfMachine + clocks * (p.cl + p.read_more + p.beats() + p.interface_cycles +
                                         (p.columns_of_request() - 1) * p.ccd_l);
  times.back = clocks * (p.cwl + p.write_more + p.wtr_s);
  times.held = clocks * (p.cwl + p.write_more + p.beats() * p.columns_of_request() + p.wtr_s);
  times.open = clocks * (p.rp + p.rcd);
  times.late = (1 - 1.0 / p.channels) * (times.turn + times.open);
  times.row_bursts = static_cast<double>(row);
  times.refresh_every = clocks * p.refi;
  times.refresh_stop = clocks * (p.rtp + p.rp_all + p.rfc + p.rcd);
  times.channels = p.channels;
  return times;
}

BusTime::BusTime(const BusTimes& times, const memory::Policy& policy)
    : times_(times),
      batch_(policy.batch * times.channels),
      low_(policy.low * times.channels),
      high_(policy.high * times.channels),
      most_(kBurstsAhead + policy.writes * times.channels) {}

double BusTime::read(double bursts, double ask) {
  // While no read waits, more than a few writes go at once. They end when reads have come and few are left.
  if (ask > free_ && waiting_ > low_) {
    const double idle = ask - free_;
    const double writes =
        std::min(waiting_, std::max(idle / times_.burst, std::min(batch_, waiting_ - low_)));
    // The way to the writes costs nothing while the bus is idle.
    const double turn = times_.turn - std::min(times_.turn - times_.back, idle);
    serve(writes, turn * std::min(1.0, writes / times_.channels));
  }
  free_ = std::max(free_, ask);
  while (bursts > 0) {
    const bool turns = waiting_ >= high_;
    if (turns && reads_ >= batch_) serve(std::min(batch_, waiting_ - low_), times_.turn);
    const double some = turns ? std::min(bursts, batch_ - reads_) : bursts;
    free_ = after(free_, some * times_.burst);
    reads_ += some;
    bursts -= some;
  }
  return free_;
}

double BusTime::hold(double at) {
  if (!overflows()) return at;
  serve(std::max(waiting_ - most_, std::min(batch_, waiting_ - low_)),
        times_.turn * std::min(1.0, reads_ / batch_));
  return std::max(at, free_);
}

// Replies come in order. So one is late if its channel writes, or that of the one before it.
double BusTime::late() const {
  const double both_read = free_ > wrote_ ? 1 - wrote_ / free_ : 0;
  return wrote_ > 0 ? times_.late * (1 - both_read * both_read) : 0;
}

double BusTime::rest(double at) const {
  return overflows() ? after(std::max(at, free_), (waiting_ - most_) * times_.burst) : at;
}

void BusTime::serve(double writes, double turning) {
  const double cycles = writes * times_.burst + turning;
  free_ = after(free_, cycles);
  wrote_ += cycles;
  waiting_ -= writes;
  reads_ = 0;
}

// Returns the end of what takes so many cycles of the bus. It stands still while the memory is refreshed.
double BusTime::after(double from, double cycles) const {
  double refresh = std::floor(from / times_.refresh_every) * times_.refresh_every;
  if (refresh > 0) from = std::max(from, refresh + times_.refresh_stop);
  for (refresh += times_.refresh_every; from + cycles > refresh; refresh += times_.refresh_every) {
    cycles -= std::max(0.0, refresh - from);
    from = refresh + times_.refresh_stop;
  }
  return from + cycles;
}

}  // namespace voxmelt::hwmodel::explore
