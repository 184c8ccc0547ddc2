// Earlier states of a run are kept in memory, as checkpoints. A run goes back to any step from the last of
// them before it.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "voxmelt/voxmelt.h"

namespace voxmelt::view {

class Past {
 public:
  struct Kept {
    std::uint32_t step;  // number of steps done; no change of that step is in it
    std::string bytes;   // of a checkpoint
  };

  explicit Past(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  // Keeps the state if it is time for it. It must be called between two steps, before anything is changed.
  // Keeping takes at most a twentieth of a run's time. Where the bytes exceed their bound, every second state
  // is forgotten, and later ones come at twice the distance.
  void offer(const Simulation& simulation);
  // Returns the last state at or before this step, or null. It holds until the next call of another function.
  const Kept* before(std::uint32_t step) const;
  void cut(std::uint32_t step);  // forgets what comes after it
  void clear() { cut(0); }

  std::size_t bytes() const;
  std::size_t size() const { return kept_.size(); }

 private:
  using Clock = std::chrono::steady_clock;
  void thin_out();

  std::size_t most_bytes_;
  std::uint32_t distance_ = 8;  // steps from one state to the next, at least
  std::vector<Kept> kept_;      // in the order of their steps
  Clock::time_point last_{};
  Clock::duration cost_{};  // of the last one
};

}  // namespace voxmelt::view
