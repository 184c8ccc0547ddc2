// A point that computes wrong bits is not verified. The file of sized channels describes the machine.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hwmodel/explore/check.h"
#include "hwmodel/explore/dram_time.h"
#include "hwmodel/explore/explore_report.h"
#include "hwmodel/explore/size_fifos.h"
#include "hwmodel/memory/sheet.h"
#include "kernel/engine/scalar/substeps.h"
#include "tests/kernel/engine/parallel/equal.h"

namespace voxmelt::hwmodel::explore {
namespace {

// A vent brings more energy than a cell can hold. No scene file can say so, but the wire notices.
TEST(ExploreCheck, APointThatFailsIsNotVerified) {
  Question question;
  question.grid = {4, 4, 4};
  question.parameters.flow.law = rule::Law::paper;
  question.steps = 2;
  question.device = load_device("zu7ev", {});
  Axes axes;
  axes.lanes = {2};
  axes.cascade = {2};
  axes.substeps = {1};
  axes.fifo_depth = {2};
  axes.overlap = {1};
  axes.coded = {0};
  axes.clock_mhz = {100};
  const state::Volume start(question.grid);
  const CheckInput input{start, worlds::implementation("reference"), {}, {}};
  const Checked good = check(question, sweep(question, axes, {}), 0, 0, input);
  EXPECT_TRUE(good.good) << good.difference;
  EXPECT_EQ(good.steps, 2u) << "one whole pass";
  question.parameters.vents = {{{{24, 24, 24}, 400}, 60000, 0, 8000, 0, 9}};
  const Checked bad = check(question, sweep(question, axes, {}), 0, 0, input);
  EXPECT_FALSE(bad.good);
  EXPECT_NE(bad.difference.find("width"), std::string::npos) << bad.difference;
}

// A pool at rest needs as many sub-steps in each step. The closed form takes the cycles of the simulation,
// and the timed run those as well.
TEST(ExploreCheck, SubstepsAreThoseThatTheStateAsksFor) {
  Question question;
  question.grid = {16, 24, 16};
  question.parameters.flow.law = rule::Law::viscous;
  question.parameters.flow.viscous.substeps = 0;
  question.parameters.flow.viscous.substeps_max = 5;
  question.parameters.flow.viscous.mobility = 190887435;  // kappa = 0.2
  question.steps = 2;
  question.device = load_device("zu7ev", {});
  state::Volume start(question.grid);
  for (int z = 0; z < 16; ++z)
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 16; ++x) {
        start.liquid.set(x, y, z, y > 0);
        start.inert.set(x, y, z, y == 0);
        start.amount.row(y, z)[x] = rule::kOne;
      }
  question.substeps = scalar::count_substeps(question.parameters, start).substeps;
  ASSERT_EQ(question.substeps, 5) << "as many as may be";
  Axes axes;
  axes.lanes = {4};
  axes.cascade = axes.overlap = {1};
  axes.substeps = {1, 2, 4};
  axes.fifo_depth = {2};
  axes.coded = {0};
  axes.clock_mhz = {100};
  const CheckInput input{start, worlds::implementation("reference"), {}, {}};
  for (const char* memory : {"", "hbm2"}) {
    if (*memory != 0) question.memory = load_memory(memory, "test");
    const Swept swept = sweep(question, axes, {});
    for (std::size_t at = 0; at < swept.points.size(); ++at) {
      const Checked checked = check(question, swept, at, 2, input);
      EXPECT_TRUE(checked.good) << checked.difference;
      EXPECT_EQ(checked.predicted, checked.cycles) << "copies: " << swept.points[at].hw.substeps;
      EXPECT_LT(std::abs(checked.error()), 0.05) << memory;
      EXPECT_GT(checked.cycles, 2 * (5 / swept.points[at].hw.substeps) * 16 * 24 * 4)
          << "passes of each step";
    }
  }
}

// A device with a memory is asked, and its best design comes with a simulation that somebody made up.
std::string said_of(std::int64_t simulated, std::int64_t predicted) {
  Question question;
  question.grid = {4, 4, 4};
  question.parameters.flow.law = rule::Law::paper;
  question.device = load_device("zu7ev", {});
  question.memory = load_memory("hbm2", "test");
  Axes axes;
  axes.lanes = axes.cascade = axes.substeps = axes.overlap = {1};
  axes.fifo_depth = {2};
  axes.coded = {0};
  axes.clock_mhz = {300};
  const Swept swept = sweep(question, axes, {});
  const Answer answer = answer_of(question, axes, swept);
  Checked checked;
  checked.steps = 2;
  checked.good = true;
  checked.on_memory = simulated;
  checked.predicted_on = predicted;
  checked.allowed = allowed_error(simulated, *question.memory, 300);
  checked.speed = 4252000;
  checked.predicted_speed = 7992000;
  const std::vector<Checked> all{checked};
  const Ranges ranges = ranges_of(question, axes, swept, answer.best, {});
  const Explored explored{question, axes, swept, answer, ranges, all, "a scene", "hbm2"};
  return text_of(explored) + json_of(explored) + csv_of(explored);
}

TEST(ExploreCheck, ADesignOutsideTheBoundsIsNotVerified) {
  const std::string outside = said_of(105528, 56144);
  EXPECT_NE(
      outside.find("4.252 Gcell-steps/s, simulated over 2 steps; the prediction was NOT WITHIN ITS BOUNDS "
                   "(predicted 7.992, -46.80 % cycles)"),
      std::string::npos)
      << outside;
  EXPECT_EQ(outside.find("and verified"), std::string::npos);
  EXPECT_EQ(outside.find(" verified, 2 steps"), std::string::npos);
  EXPECT_NE(outside.find(" NOT WITHIN ITS BOUNDS, 2 steps: 4.252"), std::string::npos);
  EXPECT_NE(outside.find("\"state\": \"outside\""), std::string::npos);
  EXPECT_NE(outside.find(",1,0,0,105528"), std::string::npos) << "on the front, not verified";
  const std::string inside = said_of(105528, 100300);
  EXPECT_NE(inside.find("4.252 Gcell-steps/s, simulated over 2 steps and verified, predicted 7.992, -4.95 %"),
            std::string::npos)
      << inside;
  EXPECT_EQ(inside.find("NOT WITHIN"), std::string::npos);
  EXPECT_NE(inside.find("\"state\": \"verified\""), std::string::npos);
}

// A refresh of hbm2 takes 5 + 14 + 260 + 14 ns: 88 cycles at 300 MHz. A run is allowed one, and 5 %.
TEST(ExploreCheck, TheBoundsAreAShareAndARefresh) {
  memory::Parameters hbm2 = load_memory("hbm2", "test");
  EXPECT_EQ(allowed_error(1000, hbm2, 300), 50 + 88);
  EXPECT_EQ(allowed_error(100000, hbm2, 300), 5000 + 88);
  EXPECT_EQ(beyond_bounds(hbm2, 500), "");
  hbm2.channels = 64;
  hbm2.interface_cycles = 401;
  EXPECT_EQ(
      beyond_bounds(hbm2, 501),
      "401 ns through controller and pins (at most 400), 64 channels (at most 32), 501 MHz (at most 500)");
  memory::Parameters by_bank = load_memory("lpddr4-3200", "test");
  EXPECT_EQ(beyond_bounds(by_bank, 500), "");
  by_bank.by_bank = true;
  EXPECT_EQ(beyond_bounds(by_bank, 500), "refreshes of banks");
}

// A single token is never kept waiting.
TEST(ExploreCheck, ForOneTokenEveryChannelIsAsShallowAsCanBe) {
  TimedRun run;
  run.parameters.flow.law = rule::Law::paper;
  run.grid = {1, 1, 1};
  run.configuration.lanes = run.configuration.cascade = 1;
  run.steps = 1;
  const Sizing sizing = size_fifos(run, {});
  ASSERT_GT(sizing.channels.size(), 3u);
  for (const SizedChannel& channel : sizing.channels) {
    EXPECT_EQ(channel.depth, 1) << channel.name;
    EXPECT_EQ(channel.one_less, 0) << channel.name;
  }
}

TEST(ExploreCheck, TheFileOfDepthsSaysTheMachine) {
  Sizing sizing;
  sizing.channels = {{"reader -> source", 5, 0, 0, 0}, {"melt -> writer", 1, 0, 0, 0}};
  Configuration machine;
  machine.lanes = 4;
  machine.cascade = 3;
  machine.substeps = 2;
  machine.stall_seed = 7;
  machine.overlap = false;
  machine.coded = true;
  machine.tile = 64;
  EXPECT_EQ(
      toml_of(sizing, machine, "sized"),
      "title = \"sized\"\n[hw]\nlanes = 4\ncascade = 3\nsubsteps = 2\noverlap = 0\ntile = 64\n"
      "coded = 1\nregisters = 0\nstall_seed = 7\n[[hw.channel]]\nname = \"reader -> source\"\ndepth = 5\n"
      "[[hw.channel]]\nname = \"melt -> writer\"\ndepth = 1\n");
  machine.overlap = true;
  machine.coded = false;
  EXPECT_NE(toml_of(sizing, machine, "sized").find("overlap = 1\ntile = 64\ncoded = 0\n"), std::string::npos);
}

}  // namespace
}  // namespace voxmelt::hwmodel::explore
