// The pipeline runs in lock-step with the reference and the SIMD kernels. It gives the same bits for every
// number of lanes, cascade, depth and stall, and the closed form predicts the cycles.
#include "tests/hwmodel/pipeline/check/lockstep_world.h"

#include <cstdint>
#include <filesystem>
#include <string>

#include "hwmodel/pipeline/time/prediction.h"

namespace voxmelt::hwmodel {
namespace {

// There are 100 random hostile worlds, under both laws and in any configuration.
TEST(Lockstep, HostileWorlds) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    worlds::Random random(seed + 77);
    const state::Grid grid{random.between(1, 18), random.between(1, 12), random.between(1, 12)};
    const Start start = hostile_start(seed, seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous, grid);
    const Configuration c{random.any({1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 16, 24, 31, 32}), random.between(1, 5),
                          random.any({1, 2, 3, 8}), random.one_in(2) ? 0 : seed};
    ASSERT_TRUE(agrees(start, c, 7)) << "seed " << seed << ", grid " << grid.x << " x " << grid.y << " x "
                                     << grid.z;
  }
}

TEST(Lockstep, Vaults) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    worlds::Random random(seed + 77);
    const state::Grid grid{random.between(2, 18), random.between(2, 8), random.between(1, 8)};
    const Configuration c{random.any({1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 16, 24, 31, 32}), random.between(1, 3),
                          random.any({1, 2, 8}), random.one_in(2) ? 0 : seed};
    ASSERT_TRUE(agrees(vault_start(seed, grid), c, 5)) << "seed " << seed;
  }
}

TEST(Lockstep, AwkwardSizes) {
  std::uint64_t seed = 1000;
  for (const int size : {1, 2, 63, 64, 65})
    for (const int axis : {0, 1, 2})
      for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
        state::Grid grid{3, 4, 5};
        (axis == 0 ? grid.x : axis == 1 ? grid.y : grid.z) = size;
        ++seed;
        const Configuration c{seed % 3 == 0   ? 1
                              : seed % 3 == 1 ? 4
                                              : 16,
                              static_cast<int>(seed % 4) + 1, seed % 2 == 0 ? 1 : 4,
                              seed % 5 == 0 ? seed : 0};
        ASSERT_TRUE(agrees(hostile_start(seed, law, grid), c, 4))
            << grid.x << " x " << grid.y << " x " << grid.z;
      }
  for (const int size : {1, 2, 63})  // all axes at once
    ASSERT_TRUE(agrees(hostile_start(++seed, rule::Law::paper, {size, size, size}), {16, 2, 2, 0}, 2));
}

// The cycles are exactly the predicted ones, over 168 configurations without stalls.
TEST(Lockstep, ClosedFormIsExact) {
  int configurations = 0;
  for (const int lanes : {1, 2, 3, 4, 7, 12, 16})
    for (const int cascade : {1, 3, 4})
      for (const int depth : {1, 2, 3, 16})
        for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
          worlds::Random random(static_cast<std::uint64_t>(lanes * 1000 + cascade * 10 + depth));
          const state::Grid grid{random.between(1, 20), random.between(1, 9), random.between(1, 9)};
          const Start start = hostile_start(static_cast<std::uint64_t>(++configurations), law, grid);
          const VerifyReport report = lockstep(start, {lanes, cascade, depth, 0}, 5);
          ASSERT_EQ(report.mismatch, nullptr) << text_of(*report.mismatch);
          ASSERT_EQ(report.cycles, report.predicted_cycles)
              << lanes << " lanes, cascade " << cascade << ", depth " << depth;
        }
  EXPECT_EQ(configurations, 168);
}

// Registers of circuits make stages later, and the closed form knows by how much. Serial dividers alone cost
// more: `verify` finds a difference in each train of passes in which none of them held a stage.
TEST(Lockstep, ClosedFormKnowsTheRegistersOfCircuits) {
  int exact = 0, held = 0;
  std::uint64_t seed = 0;
  for (const int lanes : {1, 2, 4, 7, 16})
    for (const int cascade : {1, 2, 4})
      for (const int depth : {1, 2, 8})
        for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
          for (const bool hot : {false, true}) {
            worlds::Random random(++seed);
            const state::Grid grid{random.between(1, 20), random.between(1, 24), random.between(1, 9)};
            Start start = hostile_start(seed, law, grid);
            while (start.parameters.heat.enabled != hot) start = hostile_start(++seed, law, grid);
            Configuration c{lanes, cascade, depth, 0};
            c.registers = true;
            const VerifyReport report = lockstep(start, c, 4);
            ASSERT_EQ(report.mismatch, nullptr) << name_of(c) << ":\n" << text_of(*report.mismatch);
            for (const TrainReport& train : report.trains)
              ASSERT_GE(train.cycles, train.predicted) << name_of(c);
            (report.cycles == report.predicted_cycles ? exact : held) += 1;
            if (!start.parameters.heat.enabled) {
              ASSERT_EQ(report.cycles, report.predicted_cycles) << name_of(c);
            }
          }
  EXPECT_GE(exact, 100);
  EXPECT_GT(held, 20);
}

TEST(Lockstep, TeachingScenes) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(VOXMELT_SCENES_FOLDER)) {
    const std::string name = entry.path().stem().string();
    if (!name.starts_with("lesson_") && !name.starts_with("paper_")) continue;
    const Configuration c{scenes % 2 == 0 ? 16 : 4, 1 + scenes % 4, 2, 0};
    ASSERT_TRUE(agrees(start_of(name, 60, {}), c, 2)) << name;
    ++scenes;
  }
  EXPECT_GE(scenes, 11);
}

TEST(Lockstep, CyclesOfStagesSumUnderStalls) {
  const Start start = hostile_start(3, rule::Law::paper, {20, 9, 9});
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const VerifyReport report = lockstep(start, {4, 2, 3, seed}, 4);
    ASSERT_EQ(report.mismatch, nullptr);
    ASSERT_GT(report.stages.size(), 8u);
    ASSERT_EQ(report.passes, 2) << "a new irradiance ends a pass early: then the second copy has no feed";
    std::int64_t starved = 0, blocked = 0;
    for (const StageReport& stage : report.stages) {
      EXPECT_EQ(stage.cycles.total(), report.cycles) << name_of(stage.kind);
      starved += stage.cycles.starved;
      blocked += stage.cycles.blocked;
      const std::int64_t tokens = Shape{start.volume.grid, 4}.tokens();
      if (stage.kind != StageKind::feed) {
        EXPECT_EQ(stage.cycles.busy + stage.cycles.bypassed, tokens * report.passes) << name_of(stage.kind);
      }
    }
    EXPECT_GT(starved, 0);
    EXPECT_GT(blocked, 0);
    EXPECT_EQ(report.stages.front().cycles.starved, 0) << "the reader always has a token";
    EXPECT_EQ(report.stages.back().cycles.blocked, 0) << "the writer never waits";
    for (const ChannelReport& channel : report.channels) {
      EXPECT_LE(channel.highest, channel.depth);
      EXPECT_GT(channel.highest, 0) << channel.name;
    }
  }
}

// Nothing stalls, so a stage waits for its first token and for the end, and for nothing else. A channel that
// holds one token only is full every second cycle.
TEST(Lockstep, WithoutStallsNoStageWaits) {
  for (const int depth : {1, 2, 4}) {
    const VerifyReport report = lockstep(hostile_start(5, rule::Law::paper, {20, 9, 9}), {4, 2, depth, 0}, 4);
    ASSERT_EQ(report.mismatch, nullptr);
    std::int64_t waits = 0;
    for (const StageReport& stage : report.stages)
      if (stage.kind != StageKind::feed) waits += stage.cycles.starved + stage.cycles.blocked;
    EXPECT_EQ(waits > 0, depth == 1) << depth;
    const StageCycles& reader = report.stages.front().cycles;
    EXPECT_EQ(reader.blocked > 0, depth == 1) << depth;
  }
}

// Passes of two steps and of one take turns. The second step's feed must not run while that step is bypassed.
TEST(Lockstep, IrradianceStaysInStepAcrossBypasses) {
  int worlds = 0;
  for (std::uint64_t seed = 0; worlds < 12; ++seed) {
    Start start = hostile_start(seed, seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous, {7, 6, 5});
    rule::Heat& heat = start.parameters.heat;
    if (!heat.enabled || !heat.radiation) continue;
    heat.visibility_every = 3;
    heat.sources = {{{{0, {56, 200, 40}, std::uint64_t{1} << 26}}}};
    ASSERT_TRUE(agrees(start, {2, 2, 1 + worlds % 3, 0}, 9)) << "seed " << seed;
    ++worlds;
  }
}

// Grids are thinner than the stencil. Long after the last token has come, none has left. That is no hang.
TEST(Lockstep, AFillOfThinGridsIsNoHang) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
    for (const state::Grid grid : {state::Grid{50, 30, 1}, state::Grid{3, 1500, 1}})
      EXPECT_TRUE(agrees(hostile_start(7, law, grid), {4, 1, 2, 0}, 2)) << grid.x << " x " << grid.y;
}

}  // namespace
}  // namespace voxmelt::hwmodel
