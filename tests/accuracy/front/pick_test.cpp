// Picks are made among a few points by hand.
#include "accuracy/front/pick.h"

#include <gtest/gtest.h>

#include <vector>

namespace voxmelt::accuracy::front {
namespace {

const Noise kSilent{};

Measured at(Axis axis, const Setting& setting, double curves, double map, double seconds) {
  return {.axis = axis,
          .setting = setting,
          .reference = false,
          .difference = {{0, curves, curves / 2, 0}, map},
          .seconds = seconds};
}
Measured reference(Axis axis, const Setting& setting, double seconds) {
  Measured point = at(axis, setting, 0, 0, seconds);
  point.reference = true;
  return point;
}

// The usual run takes 10 s. It errs along the step by 3 % of the map and along the rays by 0.8 %.
std::vector<Measured> points() {
  return {at(Axis::step, {.step = 2}, 0.04, 0.06, 5),
          at(Axis::step, {}, 0.01, 0.03, 10),
          at(Axis::step, {.step = 0.5}, 0.004, 0.009, 20),
          reference(Axis::step, {.step = 0.25}, 40),
          at(Axis::rays, {}, 0.008, 0.002, 10),
          reference(Axis::rays, {.rays = 16}, 14),
          at(Axis::visibility, {.interval = 8}, 0.02, 0.001, 7),
          at(Axis::visibility, {.interval = 4}, 0.009, 0.001, 8),
          at(Axis::visibility, {.interval = 2}, 0.0005, 0.0009, 11),
          reference(Axis::visibility, {}, 10),
          at(Axis::viscous, {.substeps_max = 1}, 0.002, 0.04, 3),
          at(Axis::viscous, {.substeps_max = 1, .stages_max = 16}, 0.002, 0.01, 4),
          at(Axis::viscous, {.substeps_max = 8}, 0.0001, 0.008, 6),
          at(Axis::viscous, {}, 0.0001, 0.002, 10),
          reference(Axis::viscous, {.substeps_max = 1024}, 60),
          at(Axis::grid, {.grid = 0.5}, 0.0001, 0.0001, 1),
          reference(Axis::grid, {}, 10)};
}

const Setting* cheapest(Axis axis, double bound, const Noise& noise = kSilent) {
  static const std::vector<Measured> all = points();
  const Measured* found = cheapest_within(all, axis, {}, noise, bound);
  return found == nullptr ? nullptr : &found->setting;
}

TEST(Pick, TheCheapestThatKeepsTheBound) {
  EXPECT_EQ(cheapest(Axis::visibility, 0.05)->interval, 8);
  EXPECT_EQ(cheapest(Axis::visibility, 0.01)->interval, 4);
  EXPECT_EQ(*cheapest(Axis::viscous, 0.05), (Setting{.substeps_max = 1}));
  EXPECT_EQ(*cheapest(Axis::viscous, 0.01), (Setting{.substeps_max = 1, .stages_max = 16}));
}

// The error is the larger one of curves and map.
TEST(Pick, CurvesAndMapBothCount) {
  EXPECT_EQ(*cheapest(Axis::step, 0.05), Setting{});                // step x 2: the map errs by 6 %
  EXPECT_EQ(cheapest(Axis::visibility, 0.0199)->interval, 4);       // of 8 the curves err by 2 %
  EXPECT_EQ(*cheapest(Axis::step, 0.009), (Setting{.step = 0.5}));  // keeps it exactly
  EXPECT_EQ(cheapest(Axis::step, 0.0089), nullptr);
}

// A setting that keeps the bound must save 3 % of the usual time.
TEST(Pick, TheUsualSettingStaysUnlessTimeIsSaved) {
  std::vector<Measured> all{at(Axis::viscous, {.substeps_max = 8}, 0.0001, 0.008, 9.8),
                            at(Axis::viscous, {}, 0.0001, 0.002, 10)};
  EXPECT_EQ(cheapest_within(all, Axis::viscous, {}, kSilent, 0.01), &all[1]);
  all[0].seconds = 9.6;
  EXPECT_EQ(cheapest_within(all, Axis::viscous, {}, kSilent, 0.01), &all[0]);
}

// Fewer castings and steps are less work. Their time was told wrong, or they had no limit of sub-steps.
TEST(Pick, TheCoarsestOfStepsRaysAndVisibility) {
  std::vector<Measured> steps = points();
  steps[1].seconds = 30;
  EXPECT_EQ(cheapest_within(steps, Axis::step, {}, kSilent, 0.03), &steps[1]);
  EXPECT_EQ(cheapest(Axis::visibility, 0.001)->interval, 2);
  EXPECT_EQ(*cheapest(Axis::visibility, 0.0001), Setting{});
}

// No error of a reference is known, unless nothing finer than it can be had.
TEST(Pick, AReferenceIsTheLastChoice) {
  EXPECT_EQ(cheapest(Axis::step, 0.001), nullptr);
  EXPECT_EQ(cheapest(Axis::rays, 0.001), nullptr);
  EXPECT_EQ(cheapest(Axis::viscous, 0.001)->substeps_max, 1024);
}

TEST(Pick, NoiseOfTheMapLeavesTheCurvesToJudge) {
  const Noise noise{.curves = 0.0001, .map = 0.02};
  EXPECT_EQ(*cheapest(Axis::viscous, 0.01, noise), (Setting{.substeps_max = 1}));  // its map errs by 4 %
  EXPECT_EQ(*cheapest(Axis::viscous, 0.03, noise), (Setting{.substeps_max = 1, .stages_max = 16}));
}

TEST(Pick, NoiseOfTheCurvesLeavesNothingToJudge) {
  const Noise noise{.curves = 0.011, .map = 0.02};
  EXPECT_EQ(cheapest(Axis::step, 0.01, noise), nullptr);
  EXPECT_EQ(*cheapest(Axis::visibility, 0.01, noise), Setting{});  // exact by its rule
  EXPECT_EQ(cheapest(Axis::visibility, 0.02, noise)->interval, 8);
}

TEST(Pick, AllAxesTogether) {
  const Pick found = pick(points(), {}, kSilent, 0.01);
  EXPECT_EQ(found.setting, (Setting{.step = 0.5, .interval = 4, .substeps_max = 1, .stages_max = 16}));
  EXPECT_DOUBLE_EQ(found.sum, 0.009 + 0.008 + 0.009 + 0.01);
  EXPECT_TRUE(found.without.empty());
  EXPECT_FALSE(found.none);
  EXPECT_FALSE(found.curves_alone);
  EXPECT_EQ(found.bound, 0.01);
}

// Step and rays keep no bound of 0.1 %. They stay as usual, and their errors count.
TEST(Pick, AxesThatMissTheBoundStayAsUsual) {
  const Pick found = pick(points(), {}, kSilent, 0.001);
  EXPECT_EQ(found.setting, (Setting{.interval = 2, .substeps_max = 1024}));
  EXPECT_EQ(found.without, (std::vector{Axis::step, Axis::rays}));
  EXPECT_DOUBLE_EQ(found.sum, 0.03 + 0.008 + 0.0009);
  EXPECT_FALSE(found.none);
}

TEST(Pick, CurvesAloneAreSummedIfTheMapIsNoisy) {
  const Pick found = pick(points(), {}, {.curves = 0, .map = 0.02}, 0.01);
  EXPECT_TRUE(found.curves_alone);
  EXPECT_EQ(found.setting, (Setting{.interval = 4, .substeps_max = 1}));
  EXPECT_DOUBLE_EQ(found.sum, 0.01 + 0.008 + 0.009 + 0.002);
}

TEST(Pick, NoneIfTheUsualSettingIsLeftAndMissesTheBound) {
  const std::vector<Measured> step_alone{at(Axis::step, {}, 0.01, 0.03, 10),
                                         reference(Axis::step, {.step = 0.5}, 20)};
  EXPECT_TRUE(pick(step_alone, {}, kSilent, 0.01).none);
  EXPECT_FALSE(pick(step_alone, {}, kSilent, 0.03).none);  // the usual setting keeps it
  EXPECT_EQ(pick(step_alone, {}, kSilent, 0.03).setting, Setting{});
}

}  // namespace
}  // namespace voxmelt::accuracy::front
