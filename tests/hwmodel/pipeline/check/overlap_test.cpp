// Passes that follow without a gap give the same bits in exactly the predicted cycles, and every fault is
// found where it was planted. The grids are deep, since a pass must be longer than the machine's lags.
#include <cstddef>
#include <cstdint>
#include <cstdio>

#include "hwmodel/pipeline/model/blocks.h"
#include "hwmodel/pipeline/time/prediction.h"
#include "tests/hwmodel/pipeline/check/lockstep_world.h"
#include "tests/rounds.h"

namespace voxmelt::hwmodel {
namespace {

Start deep_start(std::uint64_t seed, rule::Law law, int depth, Fault fault = Fault::none) {
  worlds::Random random(seed + 99);
  Start start = start_for(fault, seed, law, {random.between(1, 9), random.between(1, 6), depth});
  if (start.parameters.flow.law == rule::Law::viscous) start.parameters.flow.viscous.substeps = 1;
  return start;
}

// Returns the cycles of the same run if its passes do not overlap.
std::int64_t apart(const Start& start, Configuration configuration, std::uint32_t steps) {
  configuration.overlap = false;
  return lockstep(start, configuration, steps).cycles;
}

// There are 288 configurations without stalls. Each run ends with a pass of fewer steps.
TEST(Overlap, ClosedFormIsExact) {
  int configurations = 0, shorter = 0;
  for (const int lanes : {1, 2, 4, 16})
    for (const int cascade : {1, 2, 4})
      for (const int depth : {1, 2, 16})
        for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
          for (const bool overlap : {false, true}) {
            const int planes = ++configurations % 3 == 0 ? 24 : 61;
            if (!all_rounds() && (configurations - 1) / 4 % 2 == 1) continue;  // every second depth
            const Start start = deep_start(static_cast<std::uint64_t>(configurations), law, planes);
            const Configuration c{lanes, cascade, depth, 0, 1, overlap};
            const auto steps = static_cast<std::uint32_t>(2 * cascade + 1);
            std::int64_t cycles = 0;
            ASSERT_TRUE(agrees(start, c, steps, &cycles));
            if (overlap) shorter += cycles < apart(start, c, steps);
          }
  EXPECT_EQ(configurations, 144);
  EXPECT_GT(shorter, all_rounds() ? 30 : 15) << "hardly any passes overlapped";
  std::printf("             %d of %d runs were shorter with overlap\n", shorter, all_rounds() ? 72 : 36);
}

// If nothing stalls, the reader never waits: n passes cost n times their tokens, and one fill and drain.
TEST(Overlap, ATrainPaysOneFillAndDrain) {
  Start start = deep_start(3, rule::Law::paper, 80);
  start.parameters.heat.radiation = false;
  const Configuration c{4, 2, 2, 0};
  const VerifyReport one = lockstep(start, c, 2), six = lockstep(start, c, 12);
  ASSERT_TRUE(one.mismatch == nullptr && six.mismatch == nullptr);
  EXPECT_EQ(six.passes, 6);
  const Shape shape{start.volume.grid, c.lanes};
  EXPECT_EQ(six.cycles, one.cycles + 5 * shape.tokens());
  EXPECT_EQ(six.stages.front().cycles.starved, 0);
}

// Whatever stalls, no token is read before it has been written.
TEST(Overlap, HostileWorldsWithStalls) {
  for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(rounds(60)); ++seed) {
    worlds::Random random(seed + 7);
    const Start start =
        deep_start(seed + 500, seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous, random.between(20, 60));
    const Configuration c{random.any({1, 2, 3, 4, 6, 8, 11, 16}), random.between(1, 4),
                          random.any({1, 2, 3, 8}), random.one_in(3) ? 0 : seed + 1};
    ASSERT_TRUE(agrees(start, c, 9)) << "seed " << seed;
  }
}

// The blocks run alone. The reader waits for the writer's credit and sees it one cycle late, whichever of
// them runs first.
TEST(Overlap, ATokenIsReadOnlyWhenItHasBeenWritten) {
  const Shape shape{{1, 3, 1}, 1};
  state::Volume volume(shape.grid);
  for (const bool writer_first : {false, true}) {
    StateMemory memory(false);
    Writer writer(shape, memory);
    Reader reader(shape, memory);
    CellFifo out("out", 0, 1, 8, 0), in("in", 1, 1, 8, 0);
    reader.connect(out, writer);
    writer.connect(in);
    memory.begin_train(volume);
    reader.begin_pass(0);
    writer.begin_pass(0);
    std::int64_t now = 0;
    const auto cycle = [&](bool comes) {
      if (writer_first) writer.cycle(now);
      const bool last = reader.cycle(now);
      if (!writer_first) writer.cycle(now);
      if (comes) in.put()[0] = {};
      in.commit();
      out.commit();
      ++now;
      return last;
    };
    EXPECT_FALSE(cycle(false));
    EXPECT_FALSE(cycle(false));
    EXPECT_TRUE(cycle(false)) << "the last token of the pass";
    reader.add_pass(0);
    writer.add_pass(0);
    cycle(true);   // a token comes to the writer
    cycle(false);  // it is written
    EXPECT_EQ(reader.cycles().busy, 3);
    EXPECT_EQ(reader.cycles().starved, 2) << "nothing had been written when the cycle began";
    cycle(false);
    EXPECT_EQ(reader.cycles().busy, 4) << "one credit";
    cycle(false);
    EXPECT_EQ(reader.cycles().busy, 4) << "and no more";
    EXPECT_EQ(reader.cycles().starved, 3);
  }
}

struct Strikes {
  int struck = 0, blind = 0;  // runs in which a fault struck, and faults that never did
};

// Plants every n-th fault in trains of passes, till it has struck so often. A difference in any pass of a
// train names its step.
void plant(std::size_t every, int strikes, Strikes& all) {
  const auto faults = all_faults();
  for (std::size_t i = 0; i < faults.size(); i += every) {
    const FaultInfo& fault = faults[i];
    if (is_of_tiles(fault.fault)) continue;  // tile_test.cpp plants these
    int here = 0;
    for (std::uint64_t seed = 0; seed < 60 && here < strikes; ++seed) {
      const rule::Law law = seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous;
      const Start start = deep_start(seed + 900, law, 40, fault.fault);
      Configuration c{seed % 3 == 0 ? 2 : 4, 1 + static_cast<int>(seed % 2), 2, seed % 4 == 0 ? 0 : seed};
      c.coded = is_of_the_code(fault.fault);
      const VerifyReport report = lockstep(start, c, 6, fault.fault, 3);
      if (!report.strike) {
        ASSERT_EQ(report.mismatch, nullptr) << fault.name << ": " << text_of(*report.mismatch);
        continue;
      }
      ++here;
      ++all.struck;
      ASSERT_NE(report.mismatch, nullptr) << fault.name << ": struck and not found";
      ASSERT_TRUE(report.found_where_planted())
          << fault.name << ", seed " << seed << ": planted in " << report.strike->where << ", step "
          << report.strike->step << ", cell " << report.strike->x << ", " << report.strike->y << ", "
          << report.strike->z << "; found " << text_of(*report.mismatch);
    }
    all.blind += here == 0;
  }
}

TEST(Overlap, FaultsAreFoundWhereTheyWerePlanted) {
  Strikes all;
  ASSERT_NO_FATAL_FAILURE(plant(5, 1, all));
  EXPECT_GT(all.struck, 12);
  EXPECT_LT(all.blind, 6);
}

TEST(OverlapLong, EveryFaultIsFoundWhereItWasPlanted) {
  Strikes all;
  ASSERT_NO_FATAL_FAILURE(plant(1, 3, all));
  EXPECT_GT(all.struck, 100);
  EXPECT_LT(all.blind, 6);  // these faults need sub-steps, or other worlds
}

// Grids no longer than the lags go through pass by pass, as without overlap: a wait would never end.
TEST(Overlap, AShortGridIsNoHang) {
  for (const int planes : {1, 2, 5, 9, 12})
    for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
      const Start start = deep_start(static_cast<std::uint64_t>(planes), law, planes);
      for (const std::uint64_t stalls : {0u, 3u}) {
        const Configuration c{2, 2, 2, stalls};
        ASSERT_TRUE(agrees(start, c, 6)) << planes;
      }
    }
}

}  // namespace
}  // namespace voxmelt::hwmodel
