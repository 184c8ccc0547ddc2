// The check simulates points of a front: the pipeline in lock-step with the software, and its streams on the
// DRAM.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>

#include "hwmodel/explore/sweep.h"
#include "hwmodel/pipeline/check/verify.h"

namespace voxmelt::hwmodel::explore {

struct Checked {
  std::size_t point = 0;  // index into Swept::points
  std::uint32_t steps = 0;
  bool good = false;       // there is no difference
  std::string difference;  // the difference, if any
  std::int64_t compared_cells = 0;
  std::uint64_t digest = 0;                      // of the pipeline's last state
  std::int64_t cycles = 0, predicted = 0;        // while the memory always answers
  std::int64_t on_memory = 0, predicted_on = 0;  // with the memory's time
  std::int64_t allowed = 0;                      // cycles by which predicted_on may be off
  std::int64_t speed = 0, predicted_speed = 0;   // thousand cell-steps a second, in these steps
  RunEnergy energy, predicted_energy;            // of these steps
  double error() const;                          // relative error of predicted_on

  bool within_bounds() const { return std::abs(predicted_on - on_memory) <= allowed; }
  bool verified() const { return good && within_bounds(); }
};

struct CheckInput {
  const state::Volume& start;
  const step::Implementation& fast;
  step::Tuning tuning;
  std::function<void()> poll;
};

// If `steps` is 0, one whole pass is simulated.
Checked check(const Question& question, const Swept& swept, std::size_t point, std::uint32_t steps,
              const CheckInput& input);

}  // namespace voxmelt::hwmodel::explore
