// The update of the field that is drawn, on one thread: after three steps at mid-melt, and when nothing
// changed.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "render/density/density_field.h"

namespace voxmelt {
namespace {

constexpr const char* kScenes[] = {"cello", "goblet", "lava", "bunny"};
constexpr std::uint32_t kMidMelt = 600, kSteps = 3;

struct Prepared {
  explicit Prepared(const std::string& name)
      : scene(scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (name + ".toml"), {})),
        simulation(scene.parameters, std::move(scene.initial), *run::implementations().find("auto")) {
    while (simulation.steps_done() < kMidMelt) simulation.step();
  }
  int update() { return static_cast<int>(field.update(simulation.volume(), scene.look, scene.terrain)); }

  scene::Scene scene;  // its initial state has moved into the simulation
  run::Simulation simulation;
  render::DensityField field;
};

// Of this thread.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void update(benchmark::State& state, const char* scene, std::uint32_t steps) {
  Prepared prepared(scene);
  prepared.update();
  std::vector<double> times;
  double bricks = 0;
  for ([[maybe_unused]] auto _ : state) {
    for (std::uint32_t i = 0; i < steps; ++i) prepared.simulation.step();
    const double begin = processor_seconds();
    bricks += prepared.update();
    times.push_back(processor_seconds() - begin);
    state.SetIterationTime(times.back());
  }
  std::sort(times.begin(), times.end());  // the machine may be busy with others
  state.counters["least_us"] = times.front() * 1e6;
  state.counters["median_us"] = times[times.size() / 2] * 1e6;
  state.counters["bricks"] = bricks / static_cast<double>(state.iterations());
}

}  // namespace
}  // namespace voxmelt

int main(int argc, char** argv) {
  using namespace voxmelt;
  for (const char* scene : kScenes)
    for (const std::uint32_t steps : {kSteps, std::uint32_t{0}})
      benchmark::RegisterBenchmark(
          (std::string("update/") + scene + (steps == 0 ? "/nothing" : "/three_steps")).c_str(),
          [scene, steps](benchmark::State& state) { update(state, scene, steps); })
          ->UseManualTime()
          ->Unit(benchmark::kMicrosecond)
          ->Iterations(60);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
