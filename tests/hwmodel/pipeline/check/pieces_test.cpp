// Pieces fall in the pipeline, in lock-step with the software: in any configuration, in tiles, on a DRAM, and
// where pieces land in liquid. The closed forms know the stage and what its feed reads.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "hwmodel/explore/check.h"
#include "hwmodel/explore/timing.h"
#include "hwmodel/memory/sheet.h"
#include "hwmodel/pipeline/check/falling.h"
#include "hwmodel/pipeline/streams/memory_streams.h"
#include "tests/hwmodel/pipeline/check/lockstep_world.h"

namespace voxmelt::hwmodel {
namespace {

// Two boxes hang in the air over a pool. Nothing holds them.
Start boxes_over_a_pool(rule::Law law) {
  Start start = hostile_start(1, law, {20, 16, 12});
  start.parameters.heat = {};
  start.parameters.pieces = {true, 2, 40000};
  start.volume = state::Volume({20, 16, 12});
  worlds::fill(start.volume, {0, 0, 0, 20, 4, 12}, 4096);
  worlds::for_each({3, 9, 2, 8, 13, 7},
                   [&](int x, int y, int z) { worlds::put_solid(start.volume, x, y, z); });
  worlds::for_each({11, 6, 5, 17, 9, 11},
                   [&](int x, int y, int z) { worlds::put_solid(start.volume, x, y, z, 3000); });
  return start;
}

std::int64_t moved_by_the_feed(const VerifyReport& report) {
  std::int64_t bits = 0;
  for (const StageReport& stage : report.stages)
    if (stage.kind == StageKind::fall_feed) bits += stage.moved_bits;
  return bits;
}

TEST(Pieces, BoxesFallIntoAPool) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
    for (const int cascade : {1, 3}) {
      ASSERT_TRUE(agrees(boxes_over_a_pool(law), {4, cascade, 2, 0}, 9)) << cascade;
      ASSERT_TRUE(agrees(boxes_over_a_pool(law), {8, cascade, 2, 5}, 4)) << cascade;
    }
}

// The feed reads a bit a cell in steps in which something falls, and nothing in others. A box of 4 x 4 x 4
// hangs two cells above a floor, so it falls in two of five steps.
TEST(Pieces, TheFeedReadsABitACellWhileSomethingFalls) {
  Start start = hostile_start(1, rule::Law::viscous, {10, 8, 6});
  start.parameters = {};
  start.parameters.flow.law = rule::Law::viscous;
  start.parameters.pieces.fall = true;
  start.volume = state::Volume({10, 8, 6});
  worlds::for_each({0, 0, 0, 10, 1, 6},
                   [&](int x, int y, int z) { worlds::put_inert(start.volume, x, y, z, 2048); });
  worlds::for_each({3, 3, 1, 7, 7, 5},
                   [&](int x, int y, int z) { worlds::put_solid(start.volume, x, y, z); });
  const VerifyReport report = lockstep(start, {4, 2, 2, 0}, 5);
  ASSERT_EQ(report.mismatch, nullptr) << text_of(*report.mismatch);
  EXPECT_EQ(report.passes, 5) << "a pass has one step";
  EXPECT_EQ(moved_by_the_feed(report), 2 * (3 * 4) * 8 * 6) << "three blocks of four lanes, twice";
  for (const StageReport& stage : report.stages)
    if (stage.kind == StageKind::fall && stage.cascade == 0) {
      EXPECT_EQ(stage.cycles.busy, 2 * 3 * 8 * 6);
      EXPECT_EQ(stage.cycles.bypassed, 3 * 3 * 8 * 6);
    }
}

TEST(Pieces, HostileWorlds) {
  int fell = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    worlds::Random random(seed + 177);
    const state::Grid grid{random.between(1, 18), random.between(1, 12), random.between(1, 12)};
    const Start start = pieces_start(seed, seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous, grid);
    Configuration c{random.any({1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 16, 24, 31, 32}), random.between(1, 3),
                    random.any({1, 2, 3, 8}), random.one_in(2) ? 0 : seed};
    c.coded = random.one_in(3);
    ASSERT_TRUE(agrees(start, c, 5)) << "seed " << seed;
    fell += cells_that_fall(start.parameters, 0, start.volume).has_value();
  }
  EXPECT_GT(fell, 20);
}

TEST(Pieces, HostileWorldsInTilesAndOnADram) {
  int fell = 0;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    worlds::Random random(seed + 277);
    const state::Grid grid{random.between(24, 40), random.between(2, 9), random.between(2, 6)};
    const Start start = pieces_start(seed, seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous, grid);
    Configuration c{random.any({1, 2, 4}), 1, 4, 0};
    if (seed % 4 > 0) c.tile = narrow(start, c, random.between(0, 2));
    c.coded = random.one_in(2);
    VerifyOptions options;
    options.steps = 3;
    options.configuration = c;
    MemoryStreams streams(design_of(start.parameters, grid, c), c.cascade, load_memory("ddr4-2400", "test"),
                          200);
    if (seed % 2 == 0 || random.one_in(2)) options.memory = &streams;
    const VerifyReport report =
        verify(start.parameters, start.volume, 0, run::implementations().widest(), {}, options);
    ASSERT_EQ(report.mismatch, nullptr) << "seed " << seed << ", tile " << c.tile << ":\n"
                                        << text_of(*report.mismatch);
    fell += moved_by_the_feed(report) > 0;
  }
  EXPECT_GE(fell, 10);
}

// Runs on until something falls, for some 20 steps at most.
Start when_something_falls(const std::string& scene, std::uint32_t from) {
  Start start = start_of(scene, from, {});
  run::Simulation simulation(start.parameters, start.volume, run::implementations().widest());
  simulation.begin_at(start.step);
  const auto falls = [&] {
    return cells_that_fall(start.parameters, simulation.step_number(), simulation.volume()).has_value();
  };
  while (!falls() && simulation.steps_done() < 20) simulation.step();
  EXPECT_TRUE(falls()) << scene;
  start.volume = simulation.volume();
  start.step = simulation.step_number();
  return start;
}

// The head of the pillar comes down, and later a cube sinks beside it.
TEST(Pieces, TheLessonFalls) {
  ASSERT_TRUE(agrees(when_something_falls("lesson_fall", 60), {16, 1, 2, 0}, 1));
  ASSERT_TRUE(agrees(when_something_falls("lesson_fall", 93), {8, 2, 2, 0}, 1));
}

// By the closed forms, by a machine that computes nothing, and by the simulation.
TEST(Pieces, ThePredictionKnowsTheStageAndItsFeed) {
  for (const bool falls : {false, true}) {
    Start start = boxes_over_a_pool(rule::Law::paper);
    if (!falls) {
      start.volume = state::Volume(start.volume.grid);
      worlds::fill(start.volume, {0, 0, 0, 20, 4, 12}, 4096);
    }
    explore::Question question;
    question.parameters = start.parameters;
    question.grid = start.volume.grid;
    question.device = explore::load_device("zu7ev", {});
    question.memory = load_memory("ddr4-2400", "test");
    question.volume = &start.volume;
    question.falls = falls;
    explore::Axes axes = explore::usual_axes(question);
    explore::keep_only(axes,
                       {"hw.lanes=4", "hw.cascade=1", "hw.fifo_depth=2", "hw.clock_mhz=200", "hw.tile=0"});
    const explore::Swept swept = explore::sweep(question, axes, {});
    ASSERT_FALSE(swept.points.empty());
    for (std::size_t point = 0; point < swept.points.size(); ++point) {
      const explore::Checked checked =
          explore::check(question, swept, point, 1, {start.volume, run::implementations().widest(), {}, {}});
      EXPECT_TRUE(checked.good) << checked.difference;
      EXPECT_EQ(checked.cycles, checked.predicted) << falls;
      EXPECT_LT(std::abs(checked.error()), 0.1) << falls;
    }
  }
}

}  // namespace
}  // namespace voxmelt::hwmodel
