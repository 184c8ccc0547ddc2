// Stages in SystemVerilog, as Verilator compiles them, stand in the places of their models. Every token that
// they give is compared with the reference's, in hostile worlds, with and without stalls.
#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hwmodel/check/channel_trace.h"
#include "hwmodel/pipeline/model/pipeline.h"
#include "hwmodel/rtl/host/rtl_stage.h"
#include "tests/hwmodel/pipeline/check/lockstep_world.h"
#include "tests/rounds.h"

namespace voxmelt::hwmodel {
namespace {

// Counts what worlds had, so that a test knows that it looked at something.
struct Seen {
  int worlds = 0, refused = 0;
  int overlaps = 0;                           // trains of several passes
  int holds = 0;                              // worlds in which a serial divider held a stage
  std::map<std::string, std::int64_t> cells;  // by stage that stood in
};

// Half of the worlds in ./test.sh, all of them in the slow twin.
int some(int all) { return all_rounds() ? all : (all + 1) / 2; }

// Runs a machine with these stages in lock-step with the software, and notes what its channels do.
VerifyReport run(const Start& start, const Configuration& c, std::uint32_t steps, const StageMaker& make,
                 ChannelTrace& trace) {
  VerifyOptions options;
  options.steps = steps;
  options.configuration = c;
  options.machine = [&] {
    auto pipeline = std::make_unique<Pipeline>(start.parameters, start.volume.grid, c, make);
    pipeline->probe(&trace);
    return pipeline;
  };
  return verify(start.parameters, start.volume, start.step, run::implementations().widest(), {}, options);
}

void agree(const Start& start, Configuration c, std::uint32_t steps, const std::vector<std::string>& only,
           int seed, Seen& seen) {
  c.registers = true;
  const Design design = design_of(start.parameters, start.volume.grid, c);
  if (const std::string refusal = rtl_refusal(design, only); !refusal.empty()) {
    ++seen.refused;
    return;
  }
  ChannelTrace circuits, models;
  const VerifyReport report = run(start, c, steps, rtl_stages(only, seed), circuits);
  ASSERT_EQ(report.mismatch, nullptr) << start.name << ", " << name_of(c) << ", grid " << start.volume.grid.x
                                      << " x " << start.volume.grid.y << " x " << start.volume.grid.z << ":\n"
                                      << text_of(*report.mismatch);
  // Both sides of every channel do the same in every cycle, whatever stalls.
  const VerifyReport wanted = run(start, c, steps, make_stage, models);
  ASSERT_EQ(wanted.mismatch, nullptr) << text_of(*wanted.mismatch);
  const auto difference = circuits.difference(models);
  ASSERT_FALSE(difference) << start.name << ", " << name_of(c) << ": cycle " << difference->cycle
                           << ", channel " << difference->channel;
  ASSERT_GT(circuits.cycles(), 0);
  for (const TrainReport& train : report.trains) seen.overlaps += train.passes > 1;
  seen.holds += wanted.cycles != wanted.predicted_cycles && c.stall_seed == 0;
  ++seen.worlds;
  const auto cells = static_cast<std::int64_t>(start.volume.grid.cells());
  for (const StageKind kind : stages_of_step(design))
    if (rtl_has(kind) && (only.empty() || std::find(only.begin(), only.end(), name_of(kind)) != only.end()))
      seen.cells[std::string(name_of(kind))] += cells * steps;
}

Start viscous_start(std::uint64_t seed, state::Grid grid) {
  Start start = hostile_start(seed, rule::Law::viscous, grid);
  start.parameters.materials.clear();  // the circuits know one
  start.volume.material = {};
  return start;
}

Start world(std::uint64_t seed, int lanes, rule::Law law = rule::Law::paper) {
  worlds::Random random(seed * 31 + 5);
  state::Grid grid{random.between(1, 5 * lanes), random.between(12, 26),
                   random.one_in(2) ? random.between(8, 14) : random.between(1, 5)};
  if (seed % 3 == 0) grid.x = (grid.x + lanes - 1) / lanes * lanes;  // the last block is full
  Start start = law == rule::Law::viscous ? viscous_start(seed, grid) : hostile_start(seed, law, grid);
  start.parameters.flow.paper.use_table &= random.one_in(4);
  if (random.between(0, 3) != 0) start.parameters.flow.paper.reading = rule::EnergyReading::text;
  return start;
}

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
    Start start = viscous_start(number + 700, {5 * lanes, 12, 14});
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
    const Start start = viscous_start(static_cast<std::uint64_t>(seed) + 900, {2 * lanes, 40, 3});
    agree(of_runs(static_cast<std::uint64_t>(seed), start), {lanes, 1, 2}, 2, {"settle"}, seed, seen);
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
