// The ladders change one axis each, and the words of a setting are those that a user would write.
#include "accuracy/front/ladder.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

namespace voxmelt::accuracy::front {
namespace {

Setting back_along(Axis axis, Setting setting, const Setting& usual) {
  switch (axis) {
    case Axis::step:
      setting.step = usual.step;
      break;
    case Axis::rays:
      setting.rays = usual.rays;
      break;
    case Axis::visibility:
      setting.interval = usual.interval;
      break;
    case Axis::viscous:
      setting.substeps_max = usual.substeps_max;
      setting.stages_max = usual.stages_max;
      break;
    case Axis::grid:
      setting.grid = usual.grid;
      break;
    case Axis::neighbours:
      setting.neighbours = usual.neighbours;
      break;
  }
  return setting;
}

TEST(Ladder, DepartsAlongItsAxisOnlyAndHoldsTheUsualSetting) {
  for (const Subject& subject : all_subjects())
    for (const Extent extent : {Extent::quick, Extent::full}) {
      const Setting usual = usual_setting(extent);
      std::set<Axis> axes;
      for (const Ladder& ladder : ladders(subject, extent)) {
        EXPECT_TRUE(axes.insert(ladder.axis).second) << name_of(ladder.axis);
        int usual_ones = 0;
        std::set<std::string> names;
        for (const Setting& setting : ladder.settings) {
          EXPECT_EQ(back_along(ladder.axis, setting, usual), usual) << text_of(ladder.axis, setting);
          EXPECT_TRUE(names.insert(text_of(ladder.axis, setting)).second) << text_of(ladder.axis, setting);
          EXPECT_TRUE(subject.allows(setting));
          usual_ones += setting == usual;
        }
        EXPECT_EQ(usual_ones, 1) << name_of(ladder.axis);
        EXPECT_GE(ladder.settings.size(), 2u) << name_of(ladder.axis);
      }
      EXPECT_EQ(axes.count(Axis::viscous), subject.viscous);
      EXPECT_EQ(axes.count(Axis::rays), subject.radiates);
      EXPECT_EQ(axes.count(Axis::visibility), subject.radiates);
    }
}

TEST(Ladder, FullRunsAreAtTheScenesOwnSize) {
  EXPECT_EQ(usual_setting(Extent::full), Setting{});
  EXPECT_EQ(Setting{}.grid, 1);
  std::map<Axis, Setting> finest;
  for (const Ladder& ladder : ladders(all_subjects()[4], Extent::full))
    finest[ladder.axis] = ladder.reference();
  EXPECT_EQ(finest[Axis::step].step, 0.25);
  EXPECT_EQ(finest[Axis::rays].rays, 16);
  EXPECT_EQ(finest[Axis::visibility].interval, 1);
  EXPECT_EQ(finest[Axis::viscous].substeps_max, 1024);
  EXPECT_EQ(finest[Axis::viscous].stages_max, 1);
  EXPECT_EQ(finest[Axis::grid].grid, 1);
}

// The goblet conducts with 0.39. In a step of twice the length that would be 0.78, more than a scene may say.
TEST(Ladder, ALongStepEndsWhereGammaDoes) {
  const Subject& goblet = all_subjects()[1];
  ASSERT_EQ(goblet.scene, "goblet");
  EXPECT_FALSE(goblet.allows({.step = 2}));
  EXPECT_TRUE(goblet.allows({.grid = 0.5, .step = 2}));
  EXPECT_TRUE(goblet.allows({.step = 2, .neighbours = 18}));  // gamma is a third
  EXPECT_EQ(ladders(goblet, Extent::full).front().settings.front().step, 1);
}

TEST(Ladder, Words) {
  EXPECT_EQ(words_of({}), "the usual setting");
  EXPECT_EQ(words_of({.interval = 4, .substeps_max = 8}), "visibility_every = 4, substeps_max = 8");
  EXPECT_EQ(words_of({.step = 2, .rays = 4, .substeps_max = 1, .stages_max = 16}),
            "step x 2, rays_per_face = 4, substeps_max = 1, stages_max = 16");
  EXPECT_EQ(words_of({.step = 0.25}), "step 1/4");
  EXPECT_EQ(words_of({.grid = 0.375}), "the usual setting");  // of the quick set
}

}  // namespace
}  // namespace voxmelt::accuracy::front
