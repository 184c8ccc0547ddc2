// The bus of a DRAM serves reads in their order, and writes in batches between them. All channels are taken
// to do the same at once. Times are cycles of the machine.
#pragma once

#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel::explore {

struct BusTimes {
  double burst = 0;       // on the bus of all channels together
  double turn = 0;        // what a channel loses from reads to writes and back
  double latency = 0;     // from a read to its data, if it finds its row open
  double back = 0;        // from writes to reads, if there were no reads before
  double held = 0;        // how much later data come of a read right behind a write
  double open = 0;        // closes a row and opens another one
  double row_bursts = 1;  // bursts of a stream in the rows that are open at once
  double refresh_every = 0, refresh_stop = 0;
  double channels = 1;
  double late = 0;  // of a reply whose channel writes, where there are several
};

// Returns these times of a memory. `turn` is in cycles of the memory.
BusTimes bus_times(const memory::Parameters& parameters, int clock_mhz, double turn);

class BusTime {
 public:
  BusTime(const BusTimes& times, const memory::Policy& policy);

  void write(double bursts) {
    waiting_ += bursts;
    has_written_ = has_written_ || bursts > 0;
  }
  // Reads so many bursts that are asked for at `ask`, and returns when they have passed. Before them go the
  // writes whose turn it is.
  double read(double bursts, double ask);
  // If more writes wait than queues can hold, they go before anything else. Returns when, at the least `at`.
  double hold(double at);
  // Returns when the bus has taken what no queue can hold, from `at` on.
  double rest(double at) const;
  bool overflows() const { return waiting_ > most_; }
  bool has_written() const { return has_written_; }  // or is about to
  // Returns by how much replies are later in the mean, as channels do not write at the same time.
  double late() const;

 private:
  void serve(double writes, double turning);
  double after(double from, double cycles) const;

  BusTimes times_;
  bool has_written_ = false;
  double batch_, low_, high_, most_;           // bursts, of all channels
  double free_ = 0, waiting_ = 0, reads_ = 0;  // when the bus is free; writes that wait; reads since a turn
  double wrote_ = 0;                           // cycles for writes and turns
};

}  // namespace voxmelt::hwmodel::explore
