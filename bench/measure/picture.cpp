#include "bench/measure/picture.h"

#include <chrono>

#include "bench/baseline/baseline.h"
#include "kernel/run/simulation.h"
#include "render/density/density_field.h"

namespace voxmelt::measure {
namespace {

template <class Task>
double timed(const Task& task) {
  const auto start = std::chrono::steady_clock::now();
  task();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

double update_seconds(const Workload& workload, const scene::Look& look, const scene::Terrain& terrain,
                      const Candidate& candidate, int rounds) {
  step::Tuning tuning;
  tuning.threads = candidate.threads;
  run::Simulation simulation(workload.parameters, workload.start, *candidate.implementation, tuning);
  render::DensityField field;
  field.update(simulation.volume(), look, terrain, candidate.threads);
  std::vector<double> seconds;
  for (int round = 0; round < rounds; ++round) {
    simulation.step();
    seconds.push_back(timed([&] { field.update(simulation.volume(), look, terrain, candidate.threads); }));
  }
  return median(seconds);
}

double baseline_update_seconds(const Workload& workload, int rounds) {
  baseline::Baseline<float> program(workload.start, workload.parameters);
  std::vector<double> seconds;
  for (int round = 0; round < rounds; ++round) seconds.push_back(timed([&] { program.update(); }));
  return median(seconds);
}

}  // namespace voxmelt::measure
