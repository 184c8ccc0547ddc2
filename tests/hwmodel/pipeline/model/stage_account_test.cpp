// Every stage, whatever its rule, loses nothing under stalls, and accounts for each of its cycles.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "hwmodel/pipeline/model/feed.h"
#include "hwmodel/pipeline/model/irradiance_stream.h"
#include "hwmodel/pipeline/model/stages.h"
#include "tests/hwmodel/pipeline/model/stage_run.h"

namespace voxmelt::hwmodel {
namespace {

// Hands cells on, `lag` tokens late.
class Late final : public Stage {
 public:
  Late(const Design& design, std::int64_t lag)
      : Stage(StageKind::melt, design, lag), line_(design.shape.lanes, static_cast<std::size_t>(lag)) {}

 protected:
  void advance(const Cell* in, Cell* out) override {
    line_.shift();
    if (in != nullptr) std::copy(in, in + lanes(), line_.tap(0));
    if (out != nullptr) std::copy_n(line_.tap(line_.delay()), lanes(), out);
  }

 private:
  TapLine<Cell> line_;
};

TEST(StageAccount, NothingIsLostAndCyclesSum) {
  int runs = 0;
  for (const int lanes : {1, 2, 4, 16})
    for (const int depth : {1, 2, 7})
      for (const std::uint64_t seed : {0u, 1u, 2u})
        for (const int lag : {0, 1, 13}) {
          worlds::Random random(static_cast<std::uint64_t>(lanes * 100 + depth));
          const state::Grid grid{random.between(1, 20), random.between(1, 9), random.between(1, 5)};
          rule::Parameters parameters = worlds::hostile_parameters(random, rule::Law::paper, grid);
          const state::Volume volume = worlds::hostile_volume(random, parameters, grid);
          const Design design{parameters, {grid, lanes}};
          Stages stages;
          for (int i = 0; i < 3; ++i) stages.push_back(std::make_unique<Late>(design, lag));
          StageRun run{depth, seed};
          const state::Volume result = run_stages(design, stages, step::Moment(0), nullptr, volume, run);
          ASSERT_EQ(worlds::difference(volume, result), "");
          if (seed == 0) {
            const std::int64_t interval = depth == 1 ? 2 : 1, hops = 4;
            ASSERT_EQ(run.cycles, interval * (design.shape.tokens() - 1 + 3 * lag) + hops + 1)
                << lanes << " lanes, depth " << depth << ", lag " << lag;
          }
          ++runs;
        }
  EXPECT_EQ(runs, 108);
}

// Three tokens pass one stage, cycle by cycle. It keeps each of them for one move.
TEST(StageAccount, EveryCycleIsCountedAsWhatItWas) {
  const Design design{{}, {{1, 3, 1}, 1}};
  Late stage(design, 1);
  CellFifo in("in", 0, 1, 2, 0), out("out", 1, 1, 1, 0);
  stage.connect(in, out);
  stage.begin_pass(step::Moment(0), false);
  const auto cycle = [&](bool comes, bool leaves) {
    stage.cycle();
    if (comes) in.put()[0] = {};
    if (leaves) out.get();
    in.commit();
    out.commit();
  };
  const auto expect = [&](std::int64_t busy, std::int64_t starved, std::int64_t blocked, std::int64_t other) {
    EXPECT_EQ(stage.cycles().busy, busy);
    EXPECT_EQ(stage.cycles().starved, starved);
    EXPECT_EQ(stage.cycles().blocked, blocked);
    EXPECT_EQ(stage.cycles().fill_drain, other);
  };
  cycle(true, false);
  expect(0, 0, 0, 1);  // starved: nothing has come yet
  cycle(false, false);
  expect(1, 0, 0, 1);  // busy: takes the first token
  cycle(true, false);
  expect(1, 1, 0, 1);  // starved: the second one is late
  cycle(true, false);
  expect(2, 1, 0, 1);  // busy: takes the second, gives the first
  cycle(false, true);
  expect(2, 1, 1, 1);  // blocked: the first one is in the way
  cycle(false, false);
  expect(3, 1, 1, 1);  // busy: takes the third, gives the second
  cycle(false, true);
  expect(3, 1, 2, 1);  // blocked: the second one is in the way
  cycle(false, false);
  expect(3, 1, 2, 2);  // drains: gives the third
  EXPECT_TRUE(stage.done());
  cycle(false, false);
  expect(3, 1, 2, 3);  // nothing is left to do
}

// In bypass the stage hands on without lag: three cycles with a token, and one each before and after them.
TEST(StageAccount, ABypassedPassIsCountedAsSuch) {
  const Design design{{}, {{1, 3, 1}, 1}};
  Late stage(design, 1);
  CellFifo in("in", 0, 1, 2, 0), out("out", 1, 1, 2, 0);
  stage.connect(in, out);
  stage.begin_pass(step::Moment(0), true);
  for (int cycle = 0; cycle < 5; ++cycle) {
    stage.cycle();
    if (cycle < 3) in.put()[0] = {};
    if (out.valid()) out.get();
    in.commit();
    out.commit();
  }
  EXPECT_TRUE(stage.done());
  EXPECT_EQ(stage.cycles().bypassed, 3);
  EXPECT_EQ(stage.cycles().busy, 0);
  EXPECT_EQ(stage.cycles().fill_drain, 2);
  EXPECT_EQ(stage.cycles().total(), 5);
}

// A feed is bypassed in a time step that does not work. After it has fed all of its tokens, it drains.
TEST(StageAccount, AFeedIsBypassedOrDrains) {
  const Shape shape{{1, 2, 1}};
  HeatFifo out("feed", 0, 1, 4, 0);
  IrradianceFeed feed(shape, 0, out);
  std::int64_t now = 0;
  const auto cycles = [&](int n) {
    while (n-- > 0) {
      feed.cycle(now++);
      out.commit();
    }
  };
  feed.begin_pass(nullptr, 0);
  cycles(3);
  EXPECT_EQ(feed.cycles().bypassed, 3);
  const IrradianceStream dark(Irradiance(shape.grid), shape);
  feed.begin_pass(&dark, 0);
  cycles(6);
  EXPECT_EQ(feed.cycles().bypassed, 3);
  EXPECT_EQ(feed.cycles().busy, 2);
  EXPECT_EQ(feed.cycles().fill_drain, 4);
}

// The numbers are counted by hand from docs/automaton.md. Settle of cold liquid multiplies for a depth
// squared and for the two parts of a mobility. It divides for the limit and the dead zone. With heat it
// multiplies twice for the mixture of a run, twice on the way up, three times on the way down, and twice for
// the bed of a solid, and divides for each mixture.
TEST(StageAccount, UnitsOfSettle) {
  Design design{{}, {{4, 4, 4}, 1}};
  design.parameters.flow.law = rule::Law::viscous;
  const auto units = [&] { return make_stage(StageKind::settle, design)->units(); };
  EXPECT_EQ(units().multipliers, 3);
  EXPECT_EQ(units().dividers, 2);
  design.parameters.flow.thermal_viscosity = true;  // a rate, two of a parabola, and the mobility itself
  EXPECT_EQ(units().multipliers, 3 + 4);
  design.parameters.heat.enabled = true;
  EXPECT_EQ(units().multipliers, 3 + 4 + 2 + 2 + 3 + 2);
  EXPECT_EQ(units().dividers, 2 + 3);
}

// With heat each of four pairs has a product more, a cell two, and the bed of a solid two. One divider serves
// the mixture.
TEST(StageAccount, UnitsOfHeatInViscousSpread) {
  Design design{{}, {{4, 4, 4}, 1}};
  design.parameters.flow.law = rule::Law::viscous;
  const auto units = [&] { return make_stage(StageKind::viscous_spread, design)->units(); };
  const Units cold = units();
  EXPECT_EQ(cold.dividers, 0);
  design.parameters.heat.enabled = true;
  EXPECT_EQ(units().multipliers, cold.multipliers + 4 + 2 + 2);
  EXPECT_EQ(units().dividers, 1);
}

}  // namespace
}  // namespace voxmelt::hwmodel
