#include "measure/picture.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "kernel/run/simulation.h"
#include "measure/baseline/baseline.h"
#include "render/density/density_field.h"

namespace voxmelt::measure {
namespace {

// Returns the least of the seconds that `task` returns, over all rounds.
template <class Task>
double least(const Rounds& rounds, const Task& task) {
  const RoundClock clock(rounds);
  double result = std::numeric_limits<double>::infinity();
  for (int round = 0; clock.more(round); ++round) result = std::min(result, task());
  return result;
}

template <class Task>
double timed(const Task& task) {
  const auto start = std::chrono::steady_clock::now();
  task();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

double update_seconds(const Workload& workload, const scene::Look& look, const scene::Terrain& terrain,
                      const Candidate& candidate, const Rounds& rounds) {
  step::Tuning tuning;
  tuning.threads = candidate.threads;
  return least(rounds, [&] {
    run::Simulation simulation(workload.parameters, workload.start, *candidate.implementation, tuning);
    render::DensityField field;
    const auto update = [&] { field.update(simulation.volume(), look, terrain, candidate.threads); };
    update();
    simulation.step();
    return timed(update);
  });
}

double baseline_update_seconds(const Workload& workload, const Rounds& rounds) {
  baseline::Baseline<float> program(workload.start, workload.parameters);
  return least(rounds, [&] { return timed([&] { program.update(); }); });
}

}  // namespace voxmelt::measure
