// The progress line of a long run has steps/s, liquid share and time left. On a terminal it is written over,
// and into a file a line goes each minute.
#pragma once

#include <chrono>
#include <cstdint>

#include "kernel/run/simulation.h"

namespace voxmelt::app {

class Progress {
 public:
  Progress(std::uint32_t steps, bool quiet, std::uint32_t begun_at = 0);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::uint32_t done, const run::Simulation& simulation);  // looks at its volume now and then

 private:
  using Clock = std::chrono::steady_clock;
  std::uint32_t steps_, begun_at_;
  bool on_, terminal_, shown_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace voxmelt::app
