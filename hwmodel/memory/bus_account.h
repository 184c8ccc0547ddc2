// A bus account books each cycle of a data bus to its cause. It is told at each column command, which
// accounts for all the time since the data before.
#pragma once

#include <algorithm>
#include <cstdint>

#include "hwmodel/memory/counts.h"

namespace voxmelt::hwmodel::memory {

class BusAccount {
 public:
  // Notes that the queues were empty until `now`.
  void first_waits(std::int64_t now) { waits_since_ = now; }
  void refreshed() { refreshed_ = true; }

  // Books data at [begin, begin + beats), `latency` after their command. `activated` says that a row had to
  // be opened.
  void column(std::int64_t begin, int beats, int latency, bool write, int rank, bool activated, Counts& to) {
    const std::int64_t gap = begin - end_;
    const std::int64_t idle = std::clamp<std::int64_t>(waits_since_ + latency - end_, 0, gap);
    to.idle += idle;
    const bool turned = any_ && (write != write_ || rank != rank_);
    std::int64_t& cause = refreshed_ ? to.refresh : turned ? to.turnaround : activated ? to.row : to.spacing;
    cause += gap - idle;
    to.busy += beats;
    if (any_ && write != write_) ++(write ? to.read_to_write : to.write_to_read);
    any_ = true;
    write_ = write;
    rank_ = rank;
    refreshed_ = false;
    end_ = begin + beats;
  }
  std::int64_t end() const { return end_; }

 private:
  std::int64_t end_ = 0, waits_since_ = 0;
  bool any_ = false, write_ = false, refreshed_ = false;
  int rank_ = 0;
};

}  // namespace voxmelt::hwmodel::memory
