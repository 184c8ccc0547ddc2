// Stages in SystemVerilog, as Verilator compiles them, stand in the places of their models. Every token that
// they give is compared with the reference's, in hostile worlds, with and without stalls.
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/rounds.h"
#include "tests/rtl/beside_models.h"

namespace voxmelt::hwmodel {
namespace {

// Half of the worlds in ./test.sh, all of them in the slow twin.
int some(int all) { return all_rounds() ? all : (all + 1) / 2; }

// Makes all solids so hot that radiation reaches the end of the range.
void heat_solids(Start& start) {
  const state::Grid& grid = start.volume.grid;
  if (!start.parameters.heat.enabled) return;
  worlds::for_each({0, 0, 0, grid.x, grid.y, grid.z}, [&](int x, int y, int z) {
    if (start.volume.solid.test(x, y, z)) start.volume.heat[start.volume.at(x, y, z)] = 65535;
  });
}

// Random amounts hardly ever make runs that are shut, or keep their order.
Start of_runs(std::uint64_t seed, const Start& any) {
  if (seed % 3 == 0) return any;
  const state::Grid& grid = any.volume.grid;
  if (seed % 3 == 1) return vault_start(seed, grid);
  Start start{any.name + ", layers", any.parameters, state::Volume(grid)};
  worlds::Random random(seed * 6151 + 7);
  for (int z = 0; z < grid.z; ++z)
    for (int x = 0; x < grid.x; ++x)
      worlds::put_layers(random, start.volume, x, z, start.parameters.heat.enabled);
  if (!start.parameters.has_materials()) return start;
  start.volume.material = state::Field<std::uint8_t>(grid);
  const int last = static_cast<int>(start.parameters.materials.size()) - 1;
  worlds::for_each({0, 0, 0, grid.x, grid.y, grid.z}, [&](int x, int y, int z) {
    if (start.volume.solid.test(x, y, z))
      start.volume.material[start.volume.at(x, y, z)] = static_cast<std::uint8_t>(random.between(0, last));
  });
  return start;
}

// The viscous law has most stages of the paper's, and sub-steps.
void one_stage(StageKind kind, int worlds, rule::Law law = rule::Law::paper) {
  if (!rtl_has(kind)) GTEST_SKIP() << "this program was built without Verilator";
  Seen seen;
  const std::string name(name_of(kind));
  for (int seed = 0; seed < some(worlds) && !testing::Test::HasFatalFailure(); ++seed) {
    const int lanes = rtl_lanes()[seed % rtl_lanes().size()];
    Start start = world(static_cast<std::uint64_t>(seed), lanes, law);
    if (kind == StageKind::walls) {  // it is there without heat
      if (start.parameters.heat.enabled) continue;
      start.parameters.flow.fall.wall_factor = 8000;
    }
    if (kind == StageKind::fall)
      start = pieces_start(static_cast<std::uint64_t>(seed), law, start.volume.grid);
    if (kind == StageKind::settle || kind == StageKind::viscous_spread)
      start = of_runs(static_cast<std::uint64_t>(seed), start);
    if (kind == StageKind::source && !start.parameters.has_openings()) continue;
    if (kind == StageKind::exchange && seed / 2 % 2 == 0) heat_solids(start);
    if (kind == StageKind::gravity && seed / 2 % 2 == 0) {
      start.parameters.flow.paper.reading = rule::EnergyReading::printed;
      start.parameters.flow.paper.beta = seed / 4 % 2 == 0 ? 262144 : 40000;
    }
    const std::uint64_t stalls = seed % 3 == 0 ? 0 : static_cast<std::uint64_t>(seed);
    Configuration c{lanes, 1 + seed / 3 % 2, 1 + seed % 3, stalls};
    if (law == rule::Law::viscous) c.substeps = 1 + seed / 2 % 2;
    agree(start, c, 5, {name}, seed + 1, seen);
  }
  EXPECT_GT(seen.worlds, all_rounds() ? 8 : 2);
  EXPECT_GT(seen.cells[name], 0);
  if (kind != StageKind::walls) {  // it is there without heat
    EXPECT_GT(seen.materials, 0);
  }
  if (kind == StageKind::fall) return;    // the host finds pieces before each step
  if (law == rule::Law::viscous) return;  // most of these worlds are shorter than its lags: see `overlapping`
  EXPECT_GT(seen.overlaps, 0);
}

// All stages that there are stand in for their models at once.
void all_stages(int lanes, int worlds, rule::Law law) {
  const std::vector<int> there = rtl_lanes();
  if (std::find(there.begin(), there.end(), lanes) == there.end())
    GTEST_SKIP() << "this program was built without Verilator, or not for " << lanes << " lanes";
  Seen seen;
  for (int seed = 0; seed < some(worlds) && !testing::Test::HasFatalFailure(); ++seed) {
    const std::uint64_t stalls = seed % 3 == 0 ? 0 : static_cast<std::uint64_t>(seed);
    Configuration c{lanes, 1 + seed % 3, 1 + seed % 4, stalls};
    if (law == rule::Law::viscous) c.substeps = 1 + seed % 2;
    agree(world(static_cast<std::uint64_t>(seed) + 500, lanes, law), c, 6, {}, seed + 1, seen);
  }
  EXPECT_GT(seen.worlds, all_rounds() ? 8 : 2);
  EXPECT_GT(seen.materials, 0);
  EXPECT_GE(seen.cells.size(), 7u);
  EXPECT_GT(seen.holds, 1);
  EXPECT_GT(seen.overlaps, law == rule::Law::paper && all_rounds() ? 1 : 0);  // the viscous law has long lags
}
TEST(AllStagesInRtl, OneLane) { all_stages(1, 40, rule::Law::paper); }
TEST(AllStagesInRtl, FourLanes) { all_stages(4, 40, rule::Law::paper); }
TEST(AllStagesInRtl, OneLaneViscous) { all_stages(1, 24, rule::Law::viscous); }
TEST(AllStagesInRtl, FourLanesViscous) { all_stages(4, 24, rule::Law::viscous); }

// The mutants of a stage run all tests whose names begin with its own.
TEST(StagesInRtl, Walls) { one_stage(StageKind::walls, 300); }
TEST(StagesInRtl, Fall) { one_stage(StageKind::fall, 28); }
TEST(StagesInRtl, FallViscous) { one_stage(StageKind::fall, 24, rule::Law::viscous); }
TEST(StagesInRtl, Source) { one_stage(StageKind::source, 80); }
TEST(StagesInRtl, SourceViscous) { one_stage(StageKind::source, 40, rule::Law::viscous); }
TEST(StagesInRtl, Conduction) { one_stage(StageKind::conduction, 28); }
TEST(StagesInRtl, ConductionViscous) { one_stage(StageKind::conduction, 28, rule::Law::viscous); }
TEST(StagesInRtl, Edges) { one_stage(StageKind::edges, 48); }
TEST(StagesInRtl, EdgesViscous) { one_stage(StageKind::edges, 36, rule::Law::viscous); }
TEST(StagesInRtl, Corners) { one_stage(StageKind::corners, 64); }
TEST(StagesInRtl, CornersViscous) { one_stage(StageKind::corners, 48, rule::Law::viscous); }
TEST(StagesInRtl, Convection) { one_stage(StageKind::convection, 36); }
TEST(StagesInRtl, ConvectionViscous) { one_stage(StageKind::convection, 36, rule::Law::viscous); }
TEST(StagesInRtl, Exchange) { one_stage(StageKind::exchange, 36); }
TEST(StagesInRtl, ExchangeViscous) { one_stage(StageKind::exchange, 36, rule::Law::viscous); }
TEST(StagesInRtl, Melt) { one_stage(StageKind::melt, 28); }
TEST(StagesInRtl, MeltViscous) { one_stage(StageKind::melt, 28, rule::Law::viscous); }
TEST(StagesInRtl, Gravity) { one_stage(StageKind::gravity, 40); }
TEST(StagesInRtl, GravityViscous) { one_stage(StageKind::gravity, 40, rule::Law::viscous); }
TEST(StagesInRtl, Spread) { one_stage(StageKind::viscous_spread, 60, rule::Law::viscous); }

// Passes that overlap under the viscous law. Heat moves along runs, and pairs round at the seams.
void overlapping(StageKind kind) {
  if (!rtl_has(kind)) GTEST_SKIP() << "this program was built without Verilator";
  Seen seen;
  const int lanes = rtl_lanes().back();
  for (int seed = 0; seed < some(20) && !testing::Test::HasFatalFailure(); ++seed) {
    const auto number = static_cast<std::uint64_t>(seed);
    Start start = hostile_start(number + 700, rule::Law::viscous, {5 * lanes, 12, 14});
    if (!start.parameters.heat.enabled) continue;
    start.parameters.flow.viscous.substeps = 1;
    start.parameters.heat.radiation = false;  // its steps end a train
    start.parameters.heat.sources.clear();
    agree(of_runs(number + 1, start), {lanes, 1, 2}, 3, {std::string(name_of(kind))}, seed, seen);
  }
  EXPECT_GT(seen.overlaps, some(8));
  EXPECT_GT(seen.holds, some(3));
}
TEST(StagesInRtl, ConductionOverlaps) { overlapping(StageKind::conduction); }
TEST(StagesInRtl, MeltOverlaps) { overlapping(StageKind::melt); }
TEST(StagesInRtl, GravityOverlaps) { overlapping(StageKind::gravity); }
TEST(StagesInRtl, SettleOverlaps) { overlapping(StageKind::settle); }
TEST(StagesInRtl, SpreadOverlaps) { overlapping(StageKind::viscous_spread); }

// Columns so high that limits reach 1 and orders break far below a run's top.
TEST(StagesInRtl, SettleHigh) {
  if (!rtl_has(StageKind::settle)) GTEST_SKIP() << "this program was built without Verilator";
  Seen seen;
  const int lanes = rtl_lanes().back();
  for (int seed = 2; seed < 26 && !testing::Test::HasFatalFailure(); seed += 3) {  // layers
    const auto number = static_cast<std::uint64_t>(seed);
    const Start start = hostile_start(number + 900, rule::Law::viscous, {2 * lanes, 40, 3});
    agree(of_runs(number, start), {lanes, 1, 2}, 2, {"settle"}, seed, seen);
  }
  Start full{"full to the border", {}, state::Volume({2 * lanes, 130, 2})};
  full.parameters.flow.law = rule::Law::viscous;
  full.parameters.flow.viscous.mobility = 19088744;
  full.parameters.flow.viscous.stiffness = 8;
  worlds::for_each({0, 0, 0, 2 * lanes, 130, 2},
                   [&](int x, int y, int z) { worlds::put(full.volume, x, y, z, kAmountMax, 0); });
  agree(full, {lanes, 1, 2}, 2, {"settle"}, 1, seen);
  EXPECT_EQ(seen.worlds, 9);
}
TEST(StagesInRtl, Settle) { one_stage(StageKind::settle, 90, rule::Law::viscous); }
TEST(StagesInRtl, Pattern) { one_stage(StageKind::pattern, 40); }
TEST(StagesInRtl, Apply) { one_stage(StageKind::apply, 40); }

}  // namespace
}  // namespace voxmelt::hwmodel
