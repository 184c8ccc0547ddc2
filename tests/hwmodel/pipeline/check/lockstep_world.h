// Runs the lock-step checker on scenes, crops of scenes and hostile worlds.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/pipeline/check/verify.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "kernel/scene/scene.h"
#include "tests/kernel/engine/parallel/equal.h"

namespace voxmelt::hwmodel {

// Holds a state in the middle of its melt, with the number of its next step.
struct Start {
  std::string name;
  rule::Parameters parameters;
  state::Volume volume;
  std::uint32_t step = 0;
};

// Where pieces may fall a pass has one step, and most of a cascade would never work.
inline Start start_of(const std::string& scene_name, std::uint32_t ahead,
                      const std::vector<std::string>& overrides = {"pieces.fall=false"}) {
  scene::Scene scene =
      scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (scene_name + ".toml"), overrides);
  run::Simulation simulation(scene.parameters, std::move(scene.initial), run::implementations().widest());
  ahead -= scene.parameters.heat.visibility_age(ahead);
  while (simulation.steps_done() < ahead) simulation.step();
  return {scene_name, scene.parameters, simulation.volume(), simulation.step_number()};
}

// Lists the steps at which the showcase scenes are in the middle of their melt (docs/results/performance.md).
inline const std::vector<std::pair<std::string, std::uint32_t>>& showcase() {
  static const std::vector<std::pair<std::string, std::uint32_t>> scenes{
      {"cello", 1048},         {"goblet", 1100},         {"lava", 1200},         {"bunny", 896},
      {"cello_viscous", 1048}, {"goblet_viscous", 1100}, {"lava_viscous", 1200}, {"bunny_viscous", 896}};
  return scenes;
}

// Cuts out the cube of `side` cells around the most liquid. Sources, vents and air move with it.
inline Start crop(const Start& whole, int side) {
  const state::Grid g = whole.volume.grid;
  std::int64_t most = -1;
  int x0 = 0, y0 = 0, z0 = 0;
  for (int z = 0; z + side <= g.z; z += side / 2)
    for (int y = 0; y + side <= g.y; y += side / 2)
      for (int x = 0; x + side <= g.x; x += side / 2) {
        std::int64_t wet = 0;
        worlds::for_each({x, y, z, x + side, y + side, z + side},
                         [&](int cx, int cy, int cz) { wet += whole.volume.liquid.test(cx, cy, cz); });
        if (wet > most) {
          most = wet;
          x0 = x;
          y0 = y;
          z0 = z;
        }
      }
  Start cut{whole.name + " crop", whole.parameters, state::Volume({side, side, side}), whole.step};
  const bool of_materials = !whole.volume.material.empty();
  if (of_materials) cut.volume.material = state::Field<std::uint8_t>(cut.volume.grid);
  worlds::for_each({0, 0, 0, side, side, side}, [&](int x, int y, int z) {
    const state::Slot from = whole.volume.at(x0 + x, y0 + y, z0 + z), to = cut.volume.at(x, y, z);
    cut.volume.solid.set(x, y, z, whole.volume.solid.test(x0 + x, y0 + y, z0 + z));
    cut.volume.liquid.set(x, y, z, whole.volume.liquid.test(x0 + x, y0 + y, z0 + z));
    cut.volume.inert.set(x, y, z, whole.volume.inert.test(x0 + x, y0 + y, z0 + z));
    cut.volume.amount[to] = whole.volume.amount[from];
    cut.volume.energy[to] = whole.volume.energy[from];
    cut.volume.heat[to] = whole.volume.heat[from];
    if (of_materials) cut.volume.material[to] = whole.volume.material[from];
  });
  const auto move = [&](rule::Position& at) {
    at.x -= 16 * x0;
    at.y -= 16 * y0;
    at.z -= 16 * z0;
  };
  for (rule::HeatSource& source : cut.parameters.heat.sources)
    for (rule::SourceKey& key : source.keys) move(key.at);
  for (rule::Vent& vent : cut.parameters.vents) move(vent.region.at);
  for (rule::Drain& drain : cut.parameters.drains) move(drain.region.at);
  auto& air = cut.parameters.heat.air_temperature;
  if (!air.empty()) air = {air.begin() + y0, air.begin() + y0 + side};
  return cut;
}

inline Start hostile_start(std::uint64_t seed, rule::Law law, state::Grid grid) {
  worlds::Random random(seed * 6151 + (law == rule::Law::paper ? 3 : 4));
  rule::Parameters parameters = worlds::hostile_parameters(random, law, grid);
  worlds::may_freeze(random, parameters);
  state::Volume volume = worlds::hostile_volume(random, parameters, grid);
  worlds::may_be_of_materials(random, parameters, volume);
  return {"hostile " + std::to_string(seed), std::move(parameters), std::move(volume), 0};
}

// Starts with vaults that are full of liquid, where runs are shut.
inline Start vault_start(std::uint64_t seed, state::Grid grid) {
  worlds::Random random(seed * 6151 + 5);
  rule::Parameters parameters = worlds::hostile_parameters(random, rule::Law::viscous, grid);
  worlds::may_freeze(random, parameters);
  state::Volume volume(grid);
  worlds::put_vaults(random, volume, parameters.heat.enabled);
  return {"vaults " + std::to_string(seed), std::move(parameters), std::move(volume), 0};
}

// Starts with a hostile world in which pieces fall: most of its solids hang in the air or in liquid.
inline Start pieces_start(std::uint64_t seed, rule::Law law, state::Grid grid) {
  Start start = hostile_start(seed, law, grid);
  worlds::Random random(seed * 6151 + 6);
  start.name = "pieces " + std::to_string(seed);
  start.parameters.pieces = {true, random.between(1, 3), random.any({1, 40000, 65536})};
  return start;
}

// Starts with a world in which the fault may strike. Random amounts hardly ever make two shut runs that meet.
inline Start start_for(Fault fault, std::uint64_t seed, rule::Law law, state::Grid grid) {
  if (is_of_pieces(fault)) return pieces_start(seed, law, grid);
  return fault == Fault::viscous_shut ? vault_start(seed, grid) : hostile_start(seed, law, grid);
}

inline std::string name_of(const Configuration& c) {
  return "P " + std::to_string(c.lanes) + ", T " + std::to_string(c.cascade) + ", depth " +
         std::to_string(c.fifo_depth) + ", seed " + std::to_string(c.stall_seed) + ", sub-steps " +
         std::to_string(c.substeps);
}

// Returns the width of the narrowest tile that a configuration can have, and `more` blocks.
inline int narrow(const Start& start, const Configuration& c, int more) {
  const Design uncut{start.parameters, {start.volume.grid, c.lanes}, c.substeps};
  const int halo = (c.cascade * reach_of_step(uncut) + c.lanes - 1) / c.lanes;
  return (2 * halo + 1 + more) * c.lanes;
}

inline VerifyReport lockstep(const Start& start, const Configuration& configuration, std::uint32_t steps,
                             Fault fault = Fault::none, std::uint32_t fault_step = 0) {
  VerifyOptions options;
  options.steps = steps;
  options.configuration = configuration;
  options.fault = fault;
  options.fault_step = fault_step;
  return verify(start.parameters, start.volume, start.step, run::implementations().widest(), {}, options);
}

// Expects no difference, everything compared, and the predicted cycles if nothing stalls. False after a
// failure.
inline bool agrees(const Start& start, const Configuration& configuration, std::uint32_t steps,
                   std::int64_t* cycles = nullptr) {
  const VerifyReport report = lockstep(start, configuration, steps);
  if (cycles != nullptr) *cycles = report.cycles;
  const std::string where = start.name + ", " + name_of(configuration);
  EXPECT_EQ(report.mismatch, nullptr) << where << ":\n" << (report.mismatch ? text_of(*report.mismatch) : "");
  const auto cells = static_cast<std::int64_t>(start.volume.grid.cells());
  std::int64_t stages = 0;  // the stages of one time step
  for (const StageReport& stage : report.stages) stages += is_stage(stage.kind) && stage.cascade == 0;
  EXPECT_GE(stages, 3) << where;
  // A step with more sub-steps than the machine has copies takes several passes.
  if (start.parameters.flow.law == rule::Law::paper || start.parameters.flow.viscous.substeps == 1)
    EXPECT_EQ(report.compared_cells, cells * stages * steps) << where;
  else
    EXPECT_GE(report.compared_cells, cells * stages * steps) << where;
  if (configuration.stall_seed == 0) {
    EXPECT_EQ(report.cycles, report.predicted_cycles) << where;
  } else {
    EXPECT_GT(report.cycles, report.predicted_cycles) << where;
  }
  return !testing::Test::HasFailure();
}

}  // namespace voxmelt::hwmodel
