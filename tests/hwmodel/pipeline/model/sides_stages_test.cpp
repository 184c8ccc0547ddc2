// Conduction (or, without heat, the stage `walls`) writes a bit for cells that stand beside a wall, and where
// a scene freezes one for those that touch something, for melt. The former bit is the state's at the begin of
// the step, on every size of grid and number of lanes, and reaches gravity's input.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "tests/hwmodel/pipeline/model/heat_stages.h"

namespace voxmelt::hwmodel {
namespace {

// Compares the bit of every cell that passes with a volume.
class Probe final : public Stage {
 public:
  explicit Probe(const Design& design) : Stage(StageKind::melt, design, 0) {}
  const state::Volume* volume = nullptr;
  bool before_melt = false;
  std::int64_t seen = 0;

 protected:
  void advance(const Cell* in, Cell* out) override {
    std::copy_n(in, lanes(), out);
    for (int lane = 0; lane < lanes() && came().x + lane < shape().grid.x; ++lane) {
      const int x = came().x + lane, y = came().y, z = came().z;
      const bool bit = in[lane].beside_wall;
      EXPECT_EQ(bit, stands_beside_wall(*volume, x, y, z)) << x << ", " << y << ", " << z;
      const bool touches = in[lane].touches, freezes = before_melt && design().freezes();
      EXPECT_EQ(touches, freezes && touches_something(*volume, x, y, z)) << x << ", " << y << ", " << z;
      ++seen;
    }
  }
};

// Counts the cells that would fall in another way if the sides were those after the step's melt.
std::int64_t sides_that_melted(const state::Volume& before, const state::Volume& after) {
  std::int64_t count = 0;
  worlds::for_each(worlds::whole(before.grid), [&](int x, int y, int z) {
    count += after.liquid.test(x, y, z) && stands_beside_wall(before, x, y, z) &&
             !stands_beside_wall(after, x, y, z);
  });
  return count;
}

struct Totals {
  std::int64_t seen = 0, melted = 0;
};

// Runs the whole phases heat and melt, or the stage `walls` alone.
void run_probes(worlds::Random& random, state::Grid grid, int lanes, bool hot, Totals& totals) {
  Design design{worlds::hostile_parameters(random, rule::Law::paper, grid), {grid, lanes}};
  design.parameters.flow.fall.hang = 1024;
  rule::Heat& heat = design.parameters.heat;
  heat.enabled = hot;
  heat.neighbours = 26;
  heat.convection = 20000;
  heat.air = heat.radiation = true;
  heat.air_temperature.assign(static_cast<std::size_t>(grid.y), 40000);
  design.parameters.material = {30000, 0};
  if (random.one_in(2)) design.parameters.material.freezing_point = 30000;
  const state::Volume start = worlds::hostile_volume(random, design.parameters, grid);

  Stages stages;
  stages.push_back(make_stage(hot ? StageKind::conduction : StageKind::walls, design));
  std::vector<Probe*> probes;
  const auto probe = [&]() {
    auto made = std::make_unique<Probe>(design);
    made->volume = &start;
    made->before_melt = stages.back()->kind() != StageKind::melt;
    probes.push_back(made.get());
    stages.push_back(std::move(made));
  };
  probe();
  if (hot) {
    using enum StageKind;
    for (const StageKind kind : {edges, corners, convection, exchange, melt})
      stages.push_back(make_stage(kind, design));
    probe();
  }
  const step::Irradiance dark(grid);
  StageRun run{random.any({1, 2, 5}), random.one_in(2) ? 0u : 7u, 0};
  for (const std::uint32_t step : {0u, 1u}) {  // in the second pass the memories hold the first
    const state::Volume result = run_stages(design, stages, step::Moment(step), &dark, start, run);
    totals.melted += sides_that_melted(start, result);
  }
  for (const Probe* one : probes) {
    EXPECT_EQ(one->seen, 2 * static_cast<std::int64_t>(grid.cells()));
    totals.seen += one->seen;
  }
}

void every_size(bool hot, Totals& totals) {
  std::uint64_t seed = 0;
  const auto world = [&](state::Grid grid) {
    for (const int lanes : {1, 4, 16}) {
      worlds::Random random(++seed);
      run_probes(random, grid, lanes, hot, totals);
      if (testing::Test::HasFailure())
        FAIL() << grid.x << " x " << grid.y << " x " << grid.z << ", " << lanes;
    }
  };
  for (const int one : {1, 2, 63, 64, 65})
    for (const int other : {1, 2, 63, 64, 65}) {
      world({one, 2, other});
      world({one, other, 3});
    }
}

TEST(SidesStages, ConductionFindsThemAndTheyReachGravity) {
  Totals totals;
  every_size(true, totals);
  EXPECT_GT(totals.seen, 500000);
  EXPECT_GT(totals.melted, 1000);
  std::printf("             %ld cells, %ld whose last side melted\n", static_cast<long>(totals.seen),
              static_cast<long>(totals.melted));
}

TEST(SidesStages, WithoutHeatWallsFindsThem) {
  Totals totals;
  every_size(false, totals);
  EXPECT_GT(totals.seen, 200000);
}

// The stages from the step's begin to gravity do the same as the reference's phases, one after another.
TEST(SidesStages, FromHeatToGravityIsTheReferences) {
  const auto make_stages = [](const Design& design, const StageMaker& make, Stages& stages) {
    heat_of(design, make, stages);
    for (const step::Phase phase : {step::Phase::melt, step::Phase::gravity})
      phase_stages(design, make, phase, stages);
  };
  for (const std::uint64_t seed : {0u, 5000u, 90000u})
    expect_phases(rule::Law::paper, step::Phase::heat, step::Phase::gravity, make_stages, 300, 3, seed);
}

// A scene that does not freeze has no bit of it. One that does has one up to melt, those of the sides, and a
// second token in gravity. A set cell takes no bit of its own.
TEST(SidesStages, WhatFreezingTakes) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    Design plain{{}, {{4, 3, 2}, 2}};
    plain.parameters.flow.law = law;
    plain.parameters.flow.fall.wall_factor = 1;  // sides count in both
    rule::Heat& heat = plain.parameters.heat;
    heat.enabled = heat.radiation = true;
    heat.neighbours = 26;
    heat.convection = 1;
    Design freezes = plain;
    freezes.parameters.material.freezing_point = 1;
    const Stages without = make_step(plain), with = make_step(freezes);
    ASSERT_EQ(without.size(), with.size());
    for (std::size_t i = 0; i < with.size(); ++i) {
      const bool heats = phase_of(with[i]->kind()) == step::Phase::heat;
      EXPECT_EQ(with[i]->output_bits(), without[i]->output_bits() + (heats ? 1 : 0)) << with[i]->name();
      EXPECT_EQ(without[i]->lag() + (with[i]->kind() == StageKind::gravity ? 1 : 0), with[i]->lag());
      EXPECT_EQ(without[i]->units().multipliers, with[i]->units().multipliers);
    }
  }
}

// A scene that needs no sides gets none: no bit in the words, and none in the channels.
TEST(SidesStages, OnlyWhereFallingDependsOnThem) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
    for (const bool hot : {false, true})
      for (const bool walls : {false, true}) {
        Design design{{}, {{4, 3, 2}, 2}};
        design.parameters.flow.law = law;
        rule::Heat& heat = design.parameters.heat;
        heat.enabled = heat.radiation = hot;
        heat.neighbours = 26;
        heat.convection = 1;
        if (walls) design.parameters.flow.fall.hang = 1;
        const bool paper = law == rule::Law::paper;
        EXPECT_EQ(design.walls_in_conduction(), paper && hot && walls);
        bool has_stage = false;
        for (const auto& stage : make_step(design)) {
          has_stage |= stage->kind() == StageKind::walls;
          const auto its_phase = phase_of(stage->kind());
          if (its_phase != step::Phase::heat && its_phase != step::Phase::melt) continue;
          EXPECT_EQ(stage->output_bits(), design.cell_bits() + (paper && walls ? 1 : 0)) << stage->name();
        }
        EXPECT_EQ(has_stage, paper && !hot && walls);
      }
}

}  // namespace
}  // namespace voxmelt::hwmodel
