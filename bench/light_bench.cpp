// The parts of a picture that are kept up to date behind the field, on one thread: after three steps at
// mid-melt, and when nothing changed. Light: what stops it, and the sweeps. Bricks: levels, matter,
// distances.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "render/density/columns.h"
#include "render/density/density_field.h"
#include "render/ground/ground_map.h"
#include "render/light/light_matter.h"
#include "render/light/light_volume.h"
#include "render/packet/field_bricks.h"
#include "render/packet/scene_in_integers.h"
#include "render/reference/picture_scene.h"

namespace voxmelt {
namespace {

constexpr const char* kScenes[] = {"cello", "goblet", "lava", "bunny"};
constexpr std::uint32_t kMidMelt = 600, kSteps = 3;

struct Prepared {
  explicit Prepared(const std::string& name)
      : scene(scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (name + ".toml"), {})),
        simulation(scene.parameters, std::move(scene.initial), *run::implementations().find("auto")),
        look(render::look_in_integers(scene.look)),
        to_light(picture::unit_of(render::lamp_in_integers(scene.light).direction)) {
    while (simulation.steps_done() < kMidMelt) simulation.step();
    field.update(simulation.volume(), scene.look, scene.terrain);
    const state::Grid& grid = field.grid();
    ground = render::GroundMap(
        {grid.x, grid.y, grid.z},
        render::fits(scene.terrain, grid) ? render::ground_heights(scene.terrain) : field.ground(),
        field.liquid_passes(), scene.look.ground, false);
    ground.lower(field.wetness());
  }
  void step(std::uint32_t steps) {
    for (std::uint32_t i = 0; i < steps; ++i) simulation.step();
    field.update(simulation.volume(), scene.look, scene.terrain);
    ground.lower(field.wetness());
  }

  scene::Scene scene;  // its initial state has moved into the simulation
  run::Simulation simulation;
  picture::Look look;
  picture::Vector to_light;
  render::DensityField field;
  render::GroundMap ground;
  render::LightSources sources;
  render::LightVolume light;
  render::FieldBricks bricks;
  cpu::Workers workers{1};
};

// Of this thread.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void refresh(benchmark::State& state, const char* scene, std::uint32_t steps) {
  Prepared prepared(scene);
  std::vector<double> sources, sweeps, bricks, all;
  const auto part = [](std::vector<double>& times, const auto& task) {
    const double begin = processor_seconds();
    task();
    times.push_back(processor_seconds() - begin);
  };
  const auto update = [&](const std::vector<std::uint32_t>* refreshed) {
    bool lit = false;
    part(sources, [&] {
      lit = prepared.sources.update(prepared.field, prepared.ground.drawn(), prepared.look, refreshed);
    });
    part(sweeps, [&] {
      if (!lit) return;
      const picture::Vector cells{prepared.field.grid().x, prepared.field.grid().y, prepared.field.grid().z};
      prepared.light.update(prepared.sources.matter(), prepared.to_light, picture::light_shift(cells),
                            prepared.workers);
    });
    part(bricks, [&] { prepared.bricks.update(prepared.field, prepared.look, refreshed, prepared.workers); });
  };
  update(nullptr);
  for (auto* times : {&sources, &sweeps, &bricks}) times->clear();
  for ([[maybe_unused]] auto _ : state) {
    prepared.step(steps);
    update(&prepared.field.refreshed());
    all.push_back(sources.back() + sweeps.back() + bricks.back());
    state.SetIterationTime(all.back());
  }
  const auto tell = [&](const char* name, std::vector<double>& times) {
    std::sort(times.begin(), times.end());  // the machine may be busy with others
    state.counters[std::string(name) + "_least_us"] = times.front() * 1e6;
    state.counters[std::string(name) + "_us"] = times[times.size() / 2] * 1e6;
  };
  tell("all", all);
  tell("sources", sources);
  tell("sweeps", sweeps);
  tell("bricks", bricks);
}

}  // namespace
}  // namespace voxmelt

int main(int argc, char** argv) {
  using namespace voxmelt;
  for (const char* scene : kScenes)
    for (const std::uint32_t steps : {kSteps, std::uint32_t{0}})
      benchmark::RegisterBenchmark(
          (std::string("light_and_bricks/") + scene + (steps == 0 ? "/nothing" : "/three_steps")).c_str(),
          [scene, steps](benchmark::State& state) { refresh(state, scene, steps); })
          ->UseManualTime()
          ->Unit(benchmark::kMicrosecond)
          ->Iterations(60);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
