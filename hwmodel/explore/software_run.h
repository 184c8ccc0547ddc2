// This machine's software runs the same scene and steps, so that its speed stands beside an answer.
#pragma once

#include <cstdint>
#include <string>

#include "hwmodel/explore/check.h"
#include "hwmodel/explore/sweep.h"

namespace voxmelt::hwmodel::explore {

struct SoftwareRun {
  std::string implementation;
  int threads = 0;
  std::int64_t steps = 0;
  double seconds = 0;                // with casting visibility, without reading the scene
  std::int64_t speed = 0;            // thousand cell-steps a second
  std::uint32_t compared_steps = 0;  // after so many steps the state is compared; 0: never
  std::uint64_t digest = 0;          // of that state
  bool equal = true;                 // is it the pipeline's?
};

// Runs the steps of the question from its first state. `checked` is a simulated design that did not differ;
// null if there is none.
SoftwareRun run_software(const Question& question, const CheckInput& input, const Checked* checked);

}  // namespace voxmelt::hwmodel::explore
