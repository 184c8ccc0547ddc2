// The progress line of a long run has steps/s, liquid share and time left. It is shown only on a terminal.
#pragma once

#include <chrono>
#include <cstdint>

#include "kernel/automaton/state/volume.h"

namespace voxmelt::app {

class Progress {
 public:
  Progress(std::uint32_t steps, bool quiet, std::uint32_t begun_at = 0);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::uint32_t done, const state::Volume& volume);

 private:
  using Clock = std::chrono::steady_clock;
  std::uint32_t steps_, begun_at_;
  bool on_, shown_ = false;
  Clock::time_point start_ = Clock::now(), last_{};
};

}  // namespace voxmelt::app
