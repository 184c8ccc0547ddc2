#include "accuracy/trial.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "kernel/scene/start.h"
#include "measure/baseline_run.h"

namespace voxmelt::accuracy {
namespace {

constexpr std::int64_t kCellsPerThread = 50'000;

// Runs one step, or as many as take so many seconds.
std::optional<double> baseline_speed(const rule::Parameters& parameters, const state::Volume& start,
                                     double wanted) {
  measure::Workload workload;
  workload.parameters = parameters;
  workload.start = start;
  workload.times_heat = parameters.heat.enabled;
  workload.lead_steps = 0;
  workload.steps = 1;
  const auto seconds_per_step = [&]() -> std::optional<double> {
    const auto runs = measure::BaselineRuns::of(workload);
    if (!runs) return std::nullopt;
    return measure::mean(runs->plain()).total();
  };
  std::optional<double> seconds = seconds_per_step();
  if (seconds && *seconds < wanted / 2) {
    workload.steps = static_cast<int>(std::clamp(wanted / std::max(*seconds, 1e-6), 2.0, 10'000.0));
    seconds = seconds_per_step();
  }
  if (!seconds) return std::nullopt;
  return static_cast<double>(start.grid.cells()) / *seconds;
}

}  // namespace

Trial::Trial(const Conditions& conditions, const std::string& scene_name, std::vector<std::string> sets,
             const Fill& fill) {
  sets.insert(sets.end(), conditions.sets.begin(), conditions.sets.end());
  scene::Scene scene = scene::load(conditions.scenes / (scene_name + ".toml"), sets);
  if (fill) {
    scene.initial = state::Volume(scene.initial.grid);
    scene::fit_fields(scene.initial, scene.parameters);
    fill(scene.initial);
  }
  warnings_ = std::move(scene.warnings);
  if (conditions.baseline)
    baseline_ = baseline_speed(scene.parameters, scene.initial, conditions.quick ? 0.02 : 0.05);
  // On small grids threads cost more time than they save.
  const std::int64_t cells = scene.initial.grid.cells();
  step::Tuning tuning;
  tuning.threads = conditions.threads_always;
  if (tuning.threads == 0)
    tuning.threads =
        static_cast<int>(std::clamp<std::int64_t>(cells / kCellsPerThread, 1, conditions.threads));
  simulation_ = std::make_unique<run::Simulation>(scene.parameters, std::move(scene.initial),
                                                  *conditions.implementation, tuning);
}

void Trial::run_to(std::uint32_t step) {
  while (simulation_->steps_done() < step) simulation_->step();
}

std::vector<std::uint32_t> Trial::samples(std::uint32_t from, std::uint32_t end) {
  std::vector<std::uint32_t> steps;
  for (std::uint32_t step = from; step < end; step += std::max(1u, step / 10)) steps.push_back(step);
  steps.push_back(end);
  return steps;
}

Speed Trial::speed(Books books) const {
  if (books == Books::must_balance && !simulation_->drift().none())
    throw std::runtime_error("the ledgers do not balance");
  const double total = simulation_->seconds().total();
  const rule::Parameters& p = simulation_->parameters();
  Speed speed;
  speed.cells_per_second =
      static_cast<double>(volume().grid.cells()) * static_cast<double>(steps()) / std::max(total, 1e-9);
  speed.baseline_cells_per_second = baseline_;
  speed.state_bits =
      2 + 16 + (p.heat.enabled ? 16 : 0) + (p.flow.law == rule::Law::paper ? 16 : 0);  // two masks, amount
  return speed;
}

}  // namespace voxmelt::accuracy
