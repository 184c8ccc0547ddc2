#include "hwmodel/explore/software_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "kernel/automaton/state/digest.h"
#include "kernel/run/simulation.h"

namespace voxmelt::hwmodel::explore {

SoftwareRun run_software(const Question& question, const CheckInput& input, const Checked* checked) {
  run::Simulation simulation(question.parameters, input.start, input.fast, input.tuning);
  simulation.begin_at(question.first_step);
  SoftwareRun run;
  run.implementation = input.fast.name;
  run.threads = simulation.threads();
  run.steps = question.steps;
  if (checked != nullptr) run.compared_steps = checked->steps;
  std::chrono::duration<double> spent{0};
  const std::int64_t all = std::max<std::int64_t>(run.steps, run.compared_steps);
  for (std::int64_t step = 0; step < all; ++step) {
    const auto begin = std::chrono::steady_clock::now();
    simulation.step();
    if (step < run.steps) spent += std::chrono::steady_clock::now() - begin;
    if (checked != nullptr && step + 1 == run.compared_steps) {
      run.digest = state::digest(simulation.volume());
      run.equal = run.digest == checked->digest;
    }
    if (input.poll) input.poll();
  }
  run.seconds = spent.count();
  const double cell_steps = static_cast<double>(question.grid.cells()) * static_cast<double>(run.steps);
  if (run.seconds > 0) run.speed = std::llround(cell_steps * 1e-3 / run.seconds);
  return run;
}

}  // namespace voxmelt::hwmodel::explore
