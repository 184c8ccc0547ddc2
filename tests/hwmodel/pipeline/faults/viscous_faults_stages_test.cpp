// Each planted fault of settle and viscous spread strikes, and the first cell in stream order that leaves its
// phase wrong is the one that it notes.
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "hwmodel/pipeline/faults/planted_stages.h"
#include "tests/hwmodel/pipeline/model/viscous_worlds.h"
#include "tests/rounds.h"

namespace voxmelt::hwmodel {
namespace {

using step::Phase;

struct At {
  int x = -1, y = -1, z = -1;
  friend bool operator==(const At&, const At&) = default;
};
std::ostream& operator<<(std::ostream& out, const At& at) {
  return out << at.x << ", " << at.y << ", " << at.z;
}

At first_difference(const Shape& shape, const state::Volume& expected, const state::Volume& found) {
  std::vector<Cell> a(static_cast<std::size_t>(shape.lanes)), b = a;
  Place place;
  for (; place.ordinal < shape.tokens(); place.next(shape)) {
    read_token(expected, shape, place, a.data());
    read_token(found, shape, place, b.data());
    for (int lane = 0; lane < shape.lanes; ++lane)
      if (a[static_cast<std::size_t>(lane)] != b[static_cast<std::size_t>(lane)])
        return {place.x + lane, place.y, place.z};
  }
  return {};
}

// Plants `fault` in one fresh world after another, from a random step on.
void expect_found(Fault fault, Phase last, const std::string& stage, bool vaults = false, int wanted = 60) {
  int strikes = 0, later = 0, hot = 0;
  for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(rounds(400)); ++seed) {
    worlds::Random random(seed * 7919 + 3);
    const state::Grid grid = small_grid(random);
    const int lanes = random.any({1, 2, 4, 8, 16});
    ViscousWorld world =
        vaults ? ViscousWorld::of_vaults(random, grid, lanes) : ViscousWorld(random, grid, lanes);
    Stages stages;
    FaultPlan plan(fault, static_cast<std::uint32_t>(random.below(3)));
    const StageMaker make = planted_stages(plan);
    stages.push_back(make(StageKind::settle, world.design));
    if (last == Phase::spread) stages.push_back(make(StageKind::viscous_spread, world.design));
    StageRun run{2, random.one_in(2) ? 0 : seed + 1};
    for (std::uint32_t step = 0; step < 6 && !plan.struck(); ++step) {
      state::Volume start = world.simulation.volume();
      world.step([&](Phase phase, const state::Volume& before) {
        if (phase == Phase::excess) start = before;
        if (phase != last || plan.struck()) return;
        run.set = &world.set;
        const state::Volume found = run_stages(world.design, stages, world.moment, nullptr, start, run);
        const state::Volume& expected = world.simulation.volume();
        const At first = first_difference(world.design.shape, expected, found);
        ASSERT_EQ(worlds::broken_invariant(found, world.design.parameters), "");
        if (!plan.struck()) {
          ASSERT_EQ(first, At{}) << "wrong, but no strike noted";
          return;
        }
        const FaultPlan::Strike& strike = *plan.struck();
        ASSERT_EQ(strike.where, stage);
        ASSERT_EQ(strike.step, step);
        ASSERT_GE(step, plan.first_step());
        if (last == Phase::excess) {
          // A run may show wrong numbers in an earlier cell. Only the lock-step can compare those: a volume
          // lacks them.
          if (first == At{}) return;
          const Shape& shape = world.design.shape;
          ASSERT_LE(stream_order(shape, strike.x, strike.y, strike.z),
                    stream_order(shape, first.x, first.y, first.z))
              << "seed " << seed;
          ASSERT_EQ(strike.x / shape.lanes, first.x / shape.lanes) << "another column";
          ASSERT_EQ(strike.z, first.z);
        } else {
          ASSERT_EQ((At{strike.x, strike.y, strike.z}), first) << "seed " << seed;
        }
        ++strikes;
        later += step > 0;
        hot += world.design.hot();
      });
    }
  }
  const int least = all_rounds() ? wanted : wanted / 8;  // few worlds may have a little less than their share
  EXPECT_GT(strikes, least);
  EXPECT_GT(later, least / 3);
  EXPECT_GT(hot, least / 3);
}

// A damaged settling gives no number that the stage behind it cannot hold.
TEST(ViscousFaults, DamageKeepsItsWidths) {
  int strikes = 0;
  for (const Fault fault :
       {Fault::settle_run_broken, Fault::settle_sum_carry, Fault::settle_mix, Fault::settle_reversal})
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      worlds::Random random(seed);
      ViscousWorld world(random, small_grid(random), random.any({1, 4, 16}));
      Stages stages;
      FaultPlan plan(fault, 0);
      for (const StageKind kind : {StageKind::settle, StageKind::viscous_spread})
        stages.push_back(planted_stages(plan)(kind, world.design));
      StageRun run;
      const state::Volume found =
          run_stages(world.design, stages, step::Moment(0), nullptr, world.simulation.volume(), run);
      ASSERT_EQ(worlds::broken_invariant(found, world.design.parameters), "");
      strikes += plan.struck().has_value();
    }
  EXPECT_GT(strikes, 150);
}

TEST(ViscousFaults, RunBroken) { expect_found(Fault::settle_run_broken, Phase::excess, "settle"); }
TEST(ViscousFaults, SumCarry) { expect_found(Fault::settle_sum_carry, Phase::excess, "settle"); }
TEST(ViscousFaults, SettleMix) { expect_found(Fault::settle_mix, Phase::excess, "settle"); }
TEST(ViscousFaults, Reversal) { expect_found(Fault::settle_reversal, Phase::excess, "settle"); }
TEST(ViscousFaults, DeadZone) { expect_found(Fault::viscous_dead_zone, Phase::spread, "spread"); }
TEST(ViscousFaults, Shut) { expect_found(Fault::viscous_shut, Phase::spread, "spread", true); }
TEST(ViscousFaults, SetGives) { expect_found(Fault::viscous_set_gives, Phase::spread, "spread", false, 15); }
TEST(ViscousFaults, Dither) { expect_found(Fault::viscous_dither, Phase::spread, "spread"); }
TEST(ViscousFaults, Slope) { expect_found(Fault::viscous_slope, Phase::spread, "spread"); }
TEST(ViscousFaults, Across) { expect_found(Fault::viscous_across, Phase::spread, "spread"); }
TEST(ViscousFaults, Mean) { expect_found(Fault::viscous_mean, Phase::spread, "spread"); }
TEST(ViscousFaults, Substep) { expect_found(Fault::viscous_substep, Phase::spread, "spread"); }
TEST(ViscousFaults, Layer) { expect_found(Fault::viscous_layer, Phase::spread, "spread"); }
TEST(ViscousFaults, FlowLost) { expect_found(Fault::viscous_flow_lost, Phase::spread, "spread"); }

}  // namespace
}  // namespace voxmelt::hwmodel
