#include "measure/workloads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "kernel/automaton/state/digest.h"
#include "kernel/run/simulation.h"

namespace voxmelt::measure {
namespace {

// Draws a number in 0 .. n - 1 for a cell. It is the same on every machine.
std::uint32_t drawn(std::uint64_t what, std::uint64_t cell, std::uint32_t n) {
  return static_cast<std::uint32_t>(state::mixed_bits(cell * 0x9E3779B97F4A7C15u + what + 1) % n);
}

template <class Fill>  // fill(x, y, z, slot, index)
void for_each_cell(state::Volume& volume, const Fill& fill) {
  const state::Grid g = volume.grid;
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y)
      for (int x = 0; x < g.x; ++x) fill(x, y, z, volume.at(x, y, z), g.index(x, y, z));
}

// Returns the parameters of the showcase scenes, less those that would let cells rest.
rule::Parameters showcase(rule::Law law, bool heat) {
  rule::Parameters p;
  p.flow.law = law;
  p.flow.paper.threshold = 0;
  p.flow.paper.share = 8192;
  p.flow.paper.margin = 64;
  p.flow.paper.alpha_liquid = 62915;
  p.flow.paper.alpha_solid = 60293;
  p.flow.paper.alpha_floor = 60293;
  p.flow.viscous.mobility = 19088744;  // kappa = 0.02
  p.heat.enabled = heat;
  p.heat.weight_face = 2086;  // gamma = 0.1
  p.material.melting_point = 60000;
  return p;
}

std::string dense_name(int n, rule::Law law, bool heat) {
  return fmt::format("dense:{}/law:{}/heat:{}", n, law == rule::Law::paper ? "paper" : "viscous",
                     heat ? "on" : "off");
}

constexpr struct {
  const char* scene;
  std::uint32_t step;
} kMiddles[] = {{"cello", 1050}, {"goblet", 1100}, {"lava", 1200}, {"bunny", 900}, {"bunny_small", 250}};

}  // namespace

std::uint32_t middle_of(const std::string& scene) {
  for (const auto& [name, step] : kMiddles)
    if (scene == name || scene == std::string(name) + "_viscous") return step;
  return 0;
}

std::vector<std::string> usual_scenes(bool quick) {
  if (quick) return {"bunny_small", "bunny_small_viscous"};
  return {"cello",         "goblet",         "lava",         "bunny",
          "cello_viscous", "goblet_viscous", "lava_viscous", "bunny_viscous"};
}

rule::Parameters later(rule::Parameters parameters, std::uint32_t steps) {
  const auto shift = [steps](std::uint32_t& step) {
    if (step != 0xFFFFFFFFu) step -= std::min(step, steps);
  };
  for (rule::Vent& vent : parameters.vents) {
    shift(vent.from);
    shift(vent.until);
  }
  for (rule::Drain& drain : parameters.drains) {
    shift(drain.from);
    shift(drain.until);
  }
  for (rule::HeatSource& source : parameters.heat.sources) {
    // The last key that has passed stays, at step 0, so a moving source starts from there.
    while (source.keys.size() > 1 && source.keys[1].step <= steps) source.keys.erase(source.keys.begin());
    for (rule::SourceKey& key : source.keys) shift(key.step);
  }
  return parameters;
}

Workload scene_at(const scene::Scene& scene, std::uint32_t step, int threads,
                  std::unique_ptr<visibility::Provider> provider) {
  step::Tuning tuning;
  tuning.threads = threads;
  run::Simulation simulation(scene.parameters, scene.initial, run::implementations().widest(), tuning,
                             std::move(provider));
  if (scene.mid_run) simulation.resume(*scene.mid_run);
  while (simulation.steps_done() < step) simulation.step();
  Workload workload;
  workload.name = fmt::format("scene:{}/step:{}", scene.name, step);
  workload.parameters = later(scene.parameters, step);
  workload.start = simulation.volume();
  workload.times_heat = scene.parameters.heat.enabled;
  return workload;
}

Workload dense_paper(int n, bool heat) {
  Workload w;
  w.name = dense_name(n, rule::Law::paper, heat);
  w.parameters = showcase(rule::Law::paper, heat);
  w.start = state::Volume(state::Grid{n, n, n});
  w.lead_steps = w.steps = 1;
  for_each_cell(w.start, [&](int x, int y, int z, state::Slot i, std::size_t cell) {
    w.start.amount[i] = static_cast<std::uint16_t>(rule::kOne / 2 + drawn(1, cell, rule::kOne));
    w.start.energy[i] = static_cast<std::uint16_t>(1 + drawn(2, cell, rule::kOne / 2));
    if (heat) w.start.heat[i] = static_cast<std::uint16_t>(drawn(3, cell, 50000));
    w.start.liquid.set(x, y, z, true);
  });
  return w;
}

Workload dense_viscous(int n, bool heat) {
  Workload w;
  w.name = dense_name(n, rule::Law::viscous, heat);
  w.parameters = showcase(rule::Law::viscous, heat);
  w.start = state::Volume(state::Grid{n, n, n});
  w.steps = 4;
  for_each_cell(w.start, [&](int x, int y, int z, state::Slot i, std::size_t cell) {
    const std::uint32_t column = drawn(4, w.start.grid.index(x, 0, z), rule::kOne);
    w.start.amount[i] = static_cast<std::uint16_t>(rule::kOne + column / 2 + drawn(5, cell, 256));
    if (heat) w.start.heat[i] = static_cast<std::uint16_t>(drawn(3, cell, 50000));
    w.start.liquid.set(x, y, z, true);
  });
  return w;
}

Workload dense_heat(int n, int neighbours) {
  Workload w;
  w.name = fmt::format("dense:{}/solid/neighbours:{}", n, neighbours);
  w.parameters = showcase(rule::Law::paper, true);
  w.parameters.heat.neighbours = neighbours;
  w.parameters.heat.weight_edge = 1043;
  w.parameters.heat.weight_corner = 695;
  w.start = state::Volume(state::Grid{n, n, n});
  w.steps = 4;
  w.times_flow = false;
  w.times_heat = true;
  for_each_cell(w.start, [&](int x, int y, int z, state::Slot i, std::size_t cell) {
    w.start.amount[i] = rule::kOne;
    w.start.heat[i] = static_cast<std::uint16_t>(drawn(6, cell, 50000));
    w.start.solid.set(x, y, z, true);
  });
  return w;
}

Workload asleep(state::Grid grid, int depth, rule::Law law) {
  const bool cube = grid.x == grid.y && grid.y == grid.z;
  Workload w;
  w.name = fmt::format("asleep:{}/law:{}/heat:off",
                       cube ? fmt::format("{}", grid.x) : fmt::format("{}x{}x{}", grid.x, grid.y, grid.z),
                       law == rule::Law::paper ? "paper" : "viscous");
  w.parameters = showcase(law, false);
  w.parameters.flow.paper.threshold = rule::kOne / 4;
  w.start = state::Volume(grid);
  w.at_rest = true;
  w.steps = 20;
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < depth; ++y)
      for (int x = 0; x < grid.x; ++x) {
        w.start.amount[w.start.at(x, y, z)] = rule::kOne;
        w.start.liquid.set(x, y, z, true);
      }
  return w;
}

std::int64_t active_cells(const Workload& workload, bool heat) {
  return workload.start.liquid.count() + (heat ? workload.start.solid.count() : 0);
}

}  // namespace voxmelt::measure
