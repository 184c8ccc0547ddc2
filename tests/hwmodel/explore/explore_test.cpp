// The closed forms of hwmodel/explore are compared with the simulation of a DRAM, and with memories by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/explore/check.h"
#include "hwmodel/explore/dram_time.h"
#include "hwmodel/explore/part_list.h"
#include "hwmodel/explore/schedule.h"
#include "hwmodel/explore/size_fifos.h"
#include "hwmodel/memory/sheet.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/pipeline/streams/memory_streams.h"
#include "hwmodel/pipeline/time/prediction.h"
#include "tests/hwmodel/explore/memory_runs.h"

namespace voxmelt::hwmodel::explore {
namespace {

void expect_predicted(Kind kind, int least_bound) {
  double worst = 0;
  int bound = 0, runs = 0;
  for (const int lanes : {2, 8, 16})
    for (const int cascade : {1, 2, 4, 8}) {
      TimedRun timed_run = timed(lanes, cascade, 2 * cascade);
      if (kind == Kind::tiles) timed_run.configuration.tile = 48;
      if (!tile_problem(timed_run.parameters, timed_run.grid, timed_run.configuration).empty()) continue;
      const MemoryRun memory_run(timed_run, kind);
      const TimedRun& run = memory_run.run;
      if (kind == Kind::lit || kind == Kind::dark) {
        EXPECT_EQ(memory_run.content.irradiance_bits,
                  kind == Kind::lit ? 16 * memory_run.design.shape.tokens() * (lanes + 2) : 0);
      }
      const std::int64_t simulated_free = timing_of(run, nullptr).cycles;
      for (const char* name : {"ddr4-2400", "hbm2", "lpddr4-3200"}) {
        const memory::Parameters sheet = load_memory(name, "test");
        for (const int mhz : {150, 300}) {
          std::int64_t predicted = 0, free = 0;
          for (const Train& train : memory_run.trains()) {
            predicted += cycles_on(train.work, sheet, mhz, train.placement);
            free += train.work.cycles;
          }
          EXPECT_EQ(simulated_free, free);
          const std::int64_t simulated = memory_run.simulated(sheet, mhz);
          ASSERT_GT(simulated, 0);
          const double error =
              100. * static_cast<double>(predicted - simulated) / static_cast<double>(simulated);
          std::printf(
              "%-12s %2d lanes, %d steps, %d MHz: %lld cycles, without memory %lld, predicted %+.2f %%\n",
              name, lanes, cascade, mhz, static_cast<long long>(simulated), static_cast<long long>(free),
              error);
          EXPECT_LT(std::abs(error), 8) << name << ' ' << lanes << ' ' << cascade << ' ' << mhz;
          worst = std::max(worst, std::abs(error));
          bound += simulated > free + free / 10 ? 1 : 0;
          ++runs;
        }
      }
    }
  std::printf("worst error %.2f %% of %d, %d bound by the memory\n", worst, runs, bound);
  EXPECT_GE(bound, least_bound);
}
TEST(Explore, ThePipelineOnAMemoryTakesTheTimeOfTheClosedForm) { expect_predicted(Kind::lit, 20); }
TEST(Explore, ThePipelineWithoutIrradianceOnAMemory) { expect_predicted(Kind::dark, 20); }
TEST(Explore, TheCodedPipelineOnAMemory) { expect_predicted(Kind::coded, 10); }
TEST(Explore, ThePipelineInTilesOnAMemory) { expect_predicted(Kind::tiles, 10); }

// Two streams lie so many stretches apart. After 16 stretches they meet in one bank, as the row's number is
// added to the bank. The four banks of a row are different ones.
TEST(Explore, StreamsMeetInABank) {
  const memory::Parameters hbm = load_memory("hbm2", "test");  // a stretch: 4 groups, 16 bursts each
  EXPECT_EQ(meeting(0, hbm), 0) << "one row";
  EXPECT_EQ(meeting(16 * 64, hbm), 1);
  EXPECT_EQ(meeting(-16 * 64, hbm), 1);
  // Rows 0 to 3 lie in the banks 0123, 1032, 2301, 3210, and then the order begins again.
  EXPECT_EQ(meeting(64, hbm), 2 / 16.);
  EXPECT_EQ(meeting(2 * 64, hbm), 0);
  EXPECT_EQ(meeting(3 * 64, hbm), 6 / 16.);
  EXPECT_EQ(meeting(2.5 * 64, hbm), 3 / 16.);
}

// Every channel is as shallow as it can be: one token less anywhere costs cycles. This holds with stalls, and
// on a memory.
TEST(Explore, OneTokenLessAnywhereCostsCycles) {
  for (const bool on_memory : {false, true}) {
    TimedRun run = timed(4, 2, 4);
    run.grid = {16, 8, 6};
    run.configuration.stall_seed = on_memory ? 0 : 3;
    std::optional<SizingMemory> memory;
    if (on_memory) memory = {load_memory("ddr4-2400", "test"), 300};
    const Sizing sizing = size_fifos(run, memory);
    const auto cycles = [&](const Configuration& configuration) {
      TimedRun one = run;
      one.configuration = configuration;
      const Design design{run.parameters, {run.grid, configuration.lanes}, 1};
      std::optional<MemoryStreams> streams;
      if (memory) streams.emplace(design, configuration.cascade, memory->parameters, memory->clock_mhz);
      const Timing timing = timing_of(one, streams ? &*streams : nullptr);
      return timing.hangs ? INT64_MAX : timing.cycles;
    };
    Configuration deep = run.configuration, sized = run.configuration;
    deep.fifo_depth = kMostDepth;
    for (const SizedChannel& channel : sizing.channels) sized.depths.push_back({channel.name, channel.depth});
    EXPECT_EQ(sizing.deep_cycles, cycles(deep));
    EXPECT_EQ(sizing.cycles, cycles(sized));
    EXPECT_LE(sizing.cycles, sizing.deep_cycles);
    if (!on_memory) {
      EXPECT_EQ(sizing.cycles, sizing.deep_cycles);
    }
    int deeper = 0;
    for (ChannelDepth& channel : sized.depths) {
      if (channel.depth == 1) continue;
      deeper += channel.depth > 2 ? 1 : 0;
      --channel.depth;
      EXPECT_GT(cycles(sized), sizing.cycles) << channel.name;
      ++channel.depth;
    }
    EXPECT_GE(deeper, on_memory ? 0 : 4);  // stalls need room
    const Design design{run.parameters, {run.grid, 4}, 1};
    std::vector<std::string> names;
    for (const SizedChannel& channel : sizing.channels) names.push_back(channel.name);
    EXPECT_EQ(names, channel_names(design, run.configuration));
  }
}

// If sub-steps are counted from the state, a step is known when the one before it has been written.
TEST(Explore, PassesOverlapWhereTheirStepsAreKnown) {
  Design design{{}, {{8, 8, 8}, 4}};
  design.parameters.flow.law = rule::Law::viscous;
  Configuration c;
  c.lanes = 4;
  const auto trains = [&](std::uint16_t substeps) {
    design.parameters.flow.viscous.substeps = substeps;
    EXPECT_TRUE(passes_overlap(design, c, {}));
    return trains_of(design, c, 0, 6).size();
  };
  EXPECT_EQ(trains(1), 1u);
  EXPECT_EQ(trains(0), 6u);
}

// Two copies do five sub-steps in three passes, and two in one. The last number counts for all further steps.
TEST(Explore, AStepHasTheSubstepsThatItsStateAsksFor) {
  Design design{{}, {{8, 8, 8}, 4}, 2};
  design.parameters.flow.law = rule::Law::viscous;
  design.parameters.flow.viscous.substeps = 0;
  Configuration c;
  c.lanes = 4;
  c.substeps = 2;
  Content content;
  content.substeps = {5, 2};
  std::vector<std::pair<int, int>> passes;  // first sub-step and count
  std::int64_t steps = 0;
  for (const Train& train : trains_of(design, c, 0, 3, content)) {
    ASSERT_EQ(train.list.size(), 1u);
    passes.emplace_back(train.list[0].substep, train.list[0].count);
    steps += train.steps;
  }
  EXPECT_EQ(passes, (std::vector<std::pair<int, int>>{{0, 2}, {2, 2}, {4, 1}, {0, 2}, {0, 2}}));
  EXPECT_EQ(steps, 3);

  content.substeps = {10};  // passes between the first and the last, which has gravity, are of one kind
  std::vector<std::pair<int, std::int64_t>> kinds;
  for (const Train& train : kinds_of_trains(design, c, 0, 3, content))
    kinds.emplace_back(train.list[0].count, train.times);
  EXPECT_EQ(kinds, (std::vector<std::pair<int, std::int64_t>>{{2, 3}, {2, 9}, {2, 3}}));
  c.tile = 20;  // two tiles, each a train of its own
  c.overlap = false;
  const Design cut = design_of(design.parameters, {32, 8, 8}, c);
  ASSERT_EQ(cut.shape.tiles(), 2);
  for (const Design& one : {design, cut}) {
    std::int64_t cycles = 0, of_kinds = 0;
    for (const Train& train : trains_of(one, c, 0, 3, content)) cycles += train.work.cycles;
    for (const Train& train : kinds_of_trains(one, c, 0, 3, content))
      of_kinds += train.times * train.work.cycles;
    EXPECT_EQ(of_kinds, cycles);
  }
}

}  // namespace
}  // namespace voxmelt::hwmodel::explore
