// The stages of source, heat and melt agree with the reference, and their memories cost what they should.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "tests/hwmodel/pipeline/model/heat_stages.h"

namespace voxmelt::hwmodel {
namespace {

constexpr auto kBothLaws = {rule::Law::paper, rule::Law::viscous};

TEST(HeatStages, SourceIsTheReference) {
  for (const rule::Law law : kBothLaws)
    for (const std::uint64_t seed : {0u, 50000u})
      expect_phase(law, step::Phase::source, source_of, 300, 4, seed);
}

TEST(HeatStages, HeatIsTheReference) {
  for (const rule::Law law : kBothLaws)
    for (const std::uint64_t seed : {1000u, 60000u, 70000u})
      expect_phase(law, step::Phase::heat, heat_of, 300, 4, seed);
}

TEST(HeatStages, MeltIsTheReference) {
  for (const rule::Law law : kBothLaws)
    for (const std::uint64_t seed : {2000u, 80000u})
      expect_phase(law, step::Phase::melt, melt_of, 300, 4, seed);
}

// Runs the stages of a phase over a hostile world of this size, and returns the number of comparisons.
int compare_size(const state::Grid& grid, std::uint64_t seed, step::Phase phase, auto&& make) {
  worlds::Random random(seed);
  const rule::Law law = random.any({rule::Law::paper, rule::Law::viscous});
  Design design{freezing_parameters(random, law, grid), {grid, random.any({1, 2, 4, 8, 16})}};
  const state::Volume start = volume_of_materials(random, design.parameters, grid);
  Stages stages;
  make(design, make_stage, stages);
  if (stages.empty()) return 0;
  StageRun run{random.any({1, 2, 5}), random.one_in(2) ? 0 : seed, 0};
  int compared = 0;
  each_phase(design.parameters, start, phase, 2,
             [&](std::uint32_t step, const auto& before, const auto& after, auto* irradiance) {
               const state::Volume result =
                   run_stages(design, stages, step::Moment(step), irradiance, before, run);
               EXPECT_EQ(worlds::difference(after, result), "")
                   << grid.x << " x " << grid.y << " x " << grid.z << ", seed " << seed;
               ++compared;
               return true;
             });
  return compared;
}

// The sizes lie around the rows of the masks and the blocks of lanes, on each axis. One or two axes are long.
TEST(HeatStages, AwkwardSizes) {
  int compared = 0;
  std::uint64_t seed = 0;
  for (const int x : {1, 2, 63, 64, 65})
    for (const int y : {1, 2, 63, 64, 65})
      for (const int z : {1, 2, 63, 64, 65}) {
        if (std::min({x, y, z}) > 2) continue;
        compared += compare_size({x, y, z}, ++seed, step::Phase::source, source_of);
        compared += compare_size({x, y, z}, ++seed, step::Phase::heat, heat_of);
        compared += compare_size({x, y, z}, ++seed, step::Phase::melt, melt_of);
      }
  EXPECT_GT(compared, 400);
}

// The grid has large blocks in a few planes, so every tap lies in a memory of its own.
TEST(HeatStages, LargeGrid) {
  for (const rule::Law law : kBothLaws)
    for (const int lanes : {1, 16}) {
      worlds::Random random(99);
      const state::Grid grid{65, 64, 9};
      Design design{freezing_parameters(random, law, grid), {grid, lanes}};
      rule::Heat& heat = design.parameters.heat;
      heat.enabled = heat.air = heat.radiation = true;
      heat.neighbours = 26;
      heat.convection = 32767;
      Stages stages;
      heat_of(design, make_stage, stages);
      ASSERT_EQ(stages.size(), 6u);  // six stages, with the watcher
      StageRun run;
      each_phase(
          design.parameters, worlds::hostile_volume(random, design.parameters, grid), step::Phase::heat, 2,
          [&](std::uint32_t step, const auto& before, const auto& after, auto* irradiance) {
            EXPECT_EQ(worlds::difference(
                          after, run_stages(design, stages, step::Moment(step), irradiance, before, run)),
                      "");
            return true;
          });
    }
}

// The memories of a stage hold its whole lag, and are as wide as the scene needs.
TEST(HeatStages, Memories) {
  for (const auto& [air, walls] : {std::pair{false, false}, {false, true}, {true, false}, {true, true}})
    for (const rule::Law law : kBothLaws)
      for (const state::Grid grid : {state::Grid{64, 32, 16}, state::Grid{16, 1, 3}, state::Grid{1, 1, 1}}) {
        Design design{{}, {grid, 16}};
        design.parameters.flow.law = law;
        if (walls) design.parameters.flow.fall.wall_factor = 1;
        design.parameters.heat.enabled = true;
        design.parameters.heat.air = air;
        design.parameters.heat.air_temperature.resize(static_cast<std::size_t>(grid.y));
        design.parameters.heat.neighbours = 26;
        design.parameters.heat.convection = 1;
        Stages stages;
        heat_of(design, make_stage, stages);
        const std::int64_t column = grid.y, plane = design.shape.plane();
        const std::int64_t lags[] = {plane, plane + column, plane + column + 1, 1};
        const bool paper = law == rule::Law::paper;
        const int cell = paper ? 50 : 34, side = paper && walls ? 1 : 0, bits = cell + side + 16;
        for (std::size_t i = 0; i < 4; ++i) {
          EXPECT_EQ(stages[i]->lag(), lags[i]) << stages[i]->name();
          EXPECT_EQ(phase_of(stages[i]->kind()), step::Phase::heat);
          EXPECT_EQ(stages[i]->output_bits(), cell + side + (air ? 2 : 0)) << stages[i]->name();
          std::int64_t words = 0;
          for (const BufferCost& cost : stages[i]->buffers()) {
            words += cost.words * cost.lanes;
            EXPECT_GT(cost.words, 0);
            if (cost.name != "plane memory") continue;
            EXPECT_EQ(cost.bits, bits + (air ? (i == 0 ? 3 : 2) : 0)) << stages[i]->name();
          }
          EXPECT_EQ(words, lags[i] * 16) << stages[i]->name();
        }
      }
}

}  // namespace
}  // namespace voxmelt::hwmodel
