// A point that computes wrong bits is not verified. The file of sized channels describes the machine.
#include <gtest/gtest.h>

#include <string>

#include "hwmodel/explore/check.h"
#include "hwmodel/explore/size_fifos.h"
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
  EXPECT_EQ(toml_of(sizing, machine, "sized"),
            "title = \"sized\"\n[hw]\nlanes = 4\ncascade = 3\nsubsteps = 2\noverlap = 0\ntile = 64\n"
            "coded = 1\nstall_seed = 7\n[[hw.channel]]\nname = \"reader -> source\"\ndepth = 5\n"
            "[[hw.channel]]\nname = \"melt -> writer\"\ndepth = 1\n");
  machine.overlap = true;
  machine.coded = false;
  EXPECT_NE(toml_of(sizing, machine, "sized").find("overlap = 1\ntile = 64\ncoded = 0\n"), std::string::npos);
}

}  // namespace
}  // namespace voxmelt::hwmodel::explore
