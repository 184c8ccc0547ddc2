// The program tells how fast the hardware model simulates whole showcase scenes in the middle of their melt.
// It runs one time step per pass on one core, and compares nothing while the clock runs. Each result is
// checked against the reference first.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include "hwmodel/pipeline/model/pipeline.h"
#include "kernel/automaton/state/digest.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

namespace voxmelt {
namespace {

struct MidMelt {
  const char* scene;
  std::uint32_t step;  // a step of visibility if there is radiation
};
constexpr MidMelt kScenes[] = {
    {"cello", 1048}, {"lava", 1200}, {"cello_viscous", 1048}, {"lava_viscous", 1200}};
constexpr int kLanes[] = {1, 4, 16};

// Holds a state, and the result that the next step must have.
struct Prepared {
  rule::Parameters parameters;
  state::Volume before;
  step::Irradiance irradiance;
  std::uint64_t digest_after = 0;
};

Prepared prepare(const MidMelt& at) {
  scene::Scene scene =
      scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (std::string(at.scene) + ".toml"), {});
  const step::Registry& registry = run::implementations();
  run::Simulation ahead(scene.parameters, std::move(scene.initial), registry.widest());
  while (ahead.steps_done() < at.step) ahead.step();

  Prepared prepared{scene.parameters, ahead.volume(), {}, 0};
  run::Simulation reference(scene.parameters, ahead.volume(), *registry.find("reference"));
  reference.begin_at(at.step);
  reference.step();
  if (reference.irradiance() != nullptr) prepared.irradiance = *reference.irradiance();
  prepared.digest_after = state::digest(reference.volume());
  return prepared;
}

void simulate(benchmark::State& state, const MidMelt& at, int lanes) {
  const Prepared prepared = prepare(at);
  hwmodel::Pipeline pipeline(prepared.parameters, prepared.before.grid, {lanes, 1, 4, 0});
  const step::Irradiance* irradiance = prepared.irradiance.empty() ? nullptr : &prepared.irradiance;
  std::int64_t cycles = 0;
  for (auto _ : state) {
    state.PauseTiming();
    state::Volume volume = prepared.before;
    state.ResumeTiming();
    cycles += pipeline.run_pass({.first = at.step}, irradiance, volume).cycles;
    state.PauseTiming();
    if (state::digest(volume) != prepared.digest_after) {
      std::fprintf(stderr, "%s: the model's bits are not the reference's\n", at.scene);
      std::exit(1);
    }
    state.ResumeTiming();
  }
  const auto per_second = [](double count) { return benchmark::Counter(count, benchmark::Counter::kIsRate); };
  state.counters["Mcell_steps/s"] = per_second(1e-6 * static_cast<double>(prepared.before.grid.cells()) *
                                               static_cast<double>(state.iterations()));
  state.counters["Mcycles/s"] = per_second(1e-6 * static_cast<double>(cycles));
}

}  // namespace
}  // namespace voxmelt

int main(int argc, char** argv) {
  using namespace voxmelt;
  for (const MidMelt& at : kScenes)
    for (const int lanes : kLanes)
      benchmark::RegisterBenchmark((std::string(at.scene) + "/lanes:" + std::to_string(lanes)).c_str(),
                                   [&at, lanes](benchmark::State& state) { simulate(state, at, lanes); })
          ->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
