// Numbers have ranges by their sources, and the answer is sought again at the ends.
#include "hwmodel/explore/ranges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "hwmodel/explore/answer.h"
#include "kernel/scene/text/error.h"

namespace voxmelt::hwmodel::explore {
namespace {

// All stages are written in SystemVerilog, and were synthesised.
TEST(Ranges, StagesWereSynthesised) {
  const auto begin_of = [](const std::string& text) { return text.substr(0, text.find(':')); };
  for (const char* name : {"zu7ev", "ecp5-85f", "artix-200t"}) {
    const Family family = load_device(name, {}).family;
    for (const auto& [kind, cost] : family.stages) {
      EXPECT_EQ(begin_of(cost.lane.lut.source), "synthesised") << name << ": " << name_of(kind);
      EXPECT_EQ(cost.lane.ff.source, cost.lane.lut.source);
      // Four lanes of walls take fewer LUTs of 7 series than one.
      if (kind == StageKind::walls) continue;
      EXPECT_GT(cost.lane.lut.value, 0) << name << ": " << name_of(kind);
    }
    for (const LogicCost& one : {family.control, family.divider, family.random_block})
      EXPECT_EQ(begin_of(one.lut.source), "synthesised") << name;
  }
}

TEST(Ranges, FollowFromTheSource) {
  const std::vector<std::string> sets{"family.base.lut=1000", "family.base.lut_range=[900, 1700]",
                                      "family.coder.lut=70"};
  const Family f = load_device("zu7ev", sets).family;
  EXPECT_EQ(f.base.lut.low, 900);
  EXPECT_EQ(f.base.lut.high, 1700);
  EXPECT_EQ(f.coder.lut.low, 70) << "who gives a number knows it";
  EXPECT_EQ(f.coder.lut.high, 70);
  EXPECT_EQ(f.coder.ff.low, 100) << "300, assumed";
  EXPECT_EQ(f.coder.ff.high, 900);
  const Ranged<std::int64_t> gravity = load_device("artix-200t", {"family.stage.gravity.lut_range=[1, 9000]"})
                                           .family.stages.at(StageKind::gravity)
                                           .lane.lut;
  EXPECT_EQ(gravity.low, 1);
  EXPECT_EQ(gravity.high, 9000);
  const LogicCost counted =
      load_device("artix-200t", {"family.random_block.source=\"counted: by hand\""}).family.random_block;
  EXPECT_EQ(counted.lut.low, 320) << "640, counted";
  EXPECT_EQ(counted.lut.high, 1280);
  EXPECT_EQ(f.random_block.lut.low, 512) << "640, synthesised";
  EXPECT_EQ(f.random_block.lut.high, 800);
  EXPECT_EQ(load_device("zu7ev", {"device.clock=250"}).clock_mhz.high, 250);
  EXPECT_THROW(load_device("zu7ev", {"family.base.lut_range=[13000, 14000]"}), scene::InputError);
  EXPECT_THROW(load_device("zu7ev", {"device.fill_range=[0.1, 1.1]"}), scene::InputError);
  EXPECT_THROW(load_device("zu7ev", {"family.base.source=\"guessed\""}), scene::InputError);
  EXPECT_THROW(load_device("zu7ev", {"family.base.luts=3"}), scene::InputError);
}

// A number is changed, and no other one.
TEST(Ranges, OneNumberIsChanged) {
  const Device device = load_device("zu7ev", {});
  const std::vector<Coefficient> before = coefficients_of(device);
  EXPECT_EQ(before.size(), 2U + 2 * (7 + 14) - 1) << "a lane of walls is one LUT, and has no range";
  for (const Coefficient& one : before) {
    const std::vector<Coefficient> after = coefficients_of(with_value(device, one.name, one.worse));
    int changed = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (after[i].value == before[i].value) continue;
      EXPECT_EQ(after[i].name, one.name);
      EXPECT_EQ(after[i].value, one.worse);
      ++changed;
    }
    EXPECT_EQ(changed, 1) << one.name;
    EXPECT_EQ(one.better > one.worse, one.name.starts_with("device.")) << one.name;
  }
}

struct Small {
  Question question;
  Axes axes;
  explicit Small(const std::vector<std::string>& sets) {
    question.grid = {4, 4, 4};
    question.parameters.flow.law = rule::Law::paper;
    question.device = load_device("zu7ev", sets);
    axes.lanes = {1, 2};
    axes.cascade = axes.substeps = axes.overlap = {1};
    axes.fifo_depth = {2};
    axes.coded = {0};
    axes.clock_mhz = {100};
  }
  Swept swept() const { return sweep(question, axes, {}); }
};

// There are as many LUTs as two lanes take. One more for the base, and only one lane fits.
TEST(Ranges, TheBestDesignAtBothEnds) {
  const std::int64_t two = Small({}).swept().points.at(1).taken.amounts[kLut];
  const Small small({"device.fill=1", "device.lut=" + std::to_string(two),
                     "family.base.lut_range=[11000, 12001]", "family.base.lut=12000"});
  const Swept swept = small.swept();
  const Answer answer = answer_of(small.question, small.axes, swept);
  ASSERT_TRUE(answer.best);
  EXPECT_EQ(swept.points[*answer.best].hw.lanes, 2);
  const Ranges ranges = ranges_of(small.question, small.axes, swept, answer.best, {});
  const auto base = std::find_if(ranges.alone.begin(), ranges.alone.end(),
                                 [](const Alone& one) { return one.coefficient.name == "family.base.lut"; });
  ASSERT_NE(base, ranges.alone.end());
  ASSERT_TRUE(base->ends.better && base->ends.worse);
  EXPECT_EQ(base->ends.better->hw.lanes, 2);
  EXPECT_EQ(base->ends.worse->hw.lanes, 1);
  EXPECT_FALSE(base->keeps_best);
  EXPECT_FALSE(ranges.keeps_best);
  EXPECT_GT(ranges.fullest.at(*answer.best).worse, 1);
  EXPECT_LT(ranges.fullest.at(*answer.best).better, 1);
  for (const Alone& one : ranges.alone) {
    EXPECT_NE(one.coefficient.name, "device.clock") << "the question has one clock";
    EXPECT_NE(one.coefficient.name, "family.stage.spread.lut") << "the paper law has no such stage";
  }
}

// Designs that take other parts are weighed by themselves: by their steps, their channels and the code.
TEST(Ranges, EachDesignIsAsFullAsItIsAlone) {
  Small small({});
  small.axes.cascade = {1, 2};
  small.axes.fifo_depth = {1, 4};
  small.axes.coded = {0, 1};
  const Swept swept = small.swept();
  ASSERT_EQ(swept.points.size(), 16U);
  const Ranges ranges = ranges_of(small.question, small.axes, swept, 0, {});
  Device better = small.question.device, worse = better;
  for (const Alone& one : ranges.alone) {
    better = with_value(better, one.coefficient.name, one.coefficient.better);
    worse = with_value(worse, one.coefficient.name, one.coefficient.worse);
  }
  std::set<double> seen;
  for (std::size_t i = 0; i < swept.points.size(); ++i) {
    const Point& p = swept.points[i];
    EXPECT_EQ(ranges.fullest[i].better, taken_by(swept.parts[p.parts], p.hw, better).fullest) << i;
    EXPECT_EQ(ranges.fullest[i].worse, taken_by(swept.parts[p.parts], p.hw, worse).fullest) << i;
    seen.insert(ranges.fullest[i].worse);
  }
  EXPECT_EQ(seen.size(), swept.points.size()) << "no two take the same";
}

// Channels of 2 and of 64 tokens are as fast, and those of 64 take more.
TEST(Ranges, TheLeastFullOfEqualsIsTold) {
  Small small({});
  small.axes.fifo_depth = {64, 2};
  const Swept swept = small.swept();
  const Point &deep = swept.points.at(2), &shallow = swept.points.at(3);
  ASSERT_EQ(deep.speed, shallow.speed);
  ASSERT_GT(deep.taken.fullest, shallow.taken.fullest);
  const Ranges ranges = ranges_of(small.question, small.axes, swept, best_point(swept), {});
  ASSERT_TRUE(ranges.all.better && ranges.all.worse);
  EXPECT_EQ(ranges.all.better->hw.fifo_depth, 2);
  EXPECT_EQ(ranges.all.worse->hw.fifo_depth, 2);
}

TEST(Ranges, PerhapsNothingFits) {
  const std::int64_t one = Small({}).swept().points.at(0).taken.amounts[kFf];
  const Small small({"device.fill=1", "device.ff=" + std::to_string(one)});
  const Swept swept = small.swept();
  const Answer answer = answer_of(small.question, small.axes, swept);
  const Ranges ranges = ranges_of(small.question, small.axes, swept, answer.best, {});
  EXPECT_FALSE(ranges.all.worse);
  ASSERT_TRUE(ranges.all.better);
  EXPECT_EQ(ranges.all.better->hw.lanes, 2);
}

}  // namespace
}  // namespace voxmelt::hwmodel::explore
