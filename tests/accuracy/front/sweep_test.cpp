// The quick sweep of a scene is held against runs that the test makes itself.
#include "accuracy/front/sweep.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

namespace voxmelt::accuracy::front {
namespace {

const Subject& bunny() { return all_subjects()[3]; }

scene::Scene load(const Setting& setting) {
  return scene::load(VOXMELT_SCENES_FOLDER "/bunny.toml", bunny().sets(setting));
}
Curves by_reference(const Setting& setting) {  // the slowest implementation
  const scene::Scene scene = load(setting);
  run::Simulation simulation(scene.parameters, scene.initial, *run::implementations().find("reference"));
  Curves curves;
  for (std::uint32_t i = 1; i <= bunny().samples; ++i) {
    while (simulation.steps_done() < bunny().steps_to(setting, i)) simulation.step();
    curves.push_back(sample_of(simulation.volume(), bunny().scale(setting)));
  }
  return curves;
}
Curves in_double(const Setting& setting) {
  const scene::Scene scene = load(setting);
  const std::unique_ptr<Twin> twin = make_twin(kExact, scene.parameters, scene.initial);
  Curves curves;
  for (std::uint32_t i = 1, done = 0; i <= bunny().samples; ++i) {
    for (; done < bunny().steps_to(setting, i); ++done) twin->step();
    curves.push_back(sample_of(*twin, bunny().scale(setting)));
  }
  return curves;
}

const Swept& quick() {
  static const Swept swept = [] {
    Conditions conditions;
    conditions.implementation = &run::implementations().widest();
    conditions.threads = 2;
    conditions.scenes = VOXMELT_SCENES_FOLDER;
    return sweep(bunny(), Extent::quick, conditions, [](const Choice&) {});
  }();
  return swept;
}

const Measured& point(const std::string& text) {
  for (const Measured& one : quick().points)
    if (text_of(one.choice) == text) return one;
  ADD_FAILURE() << "no point " << text;
  return quick().points.front();
}

// The three errors are what they say, computed here from runs of other programs.
TEST(Sweep, ErrorsOfTheUsualSetting) {
  const Setting usual = usual_setting(Extent::quick);
  const Setting finest{.grid = 0.25, .step = 0.5, .neighbours = 26, .rays = 16, .interval = 1};
  const Curves found = by_reference(usual), exact = in_double(usual), reference = in_double(finest);
  const Measured& measured = point("the usual setting");
  for (const auto curve : kCurves) {
    EXPECT_DOUBLE_EQ((*measured.arithmetic).*curve, errors(found, exact).*curve);
    EXPECT_DOUBLE_EQ((*measured.model).*curve, errors(exact, reference).*curve);
    EXPECT_DOUBLE_EQ((*measured.whole).*curve, errors(found, reference).*curve);
  }
  EXPECT_GT(measured.model->largest(), 10 * measured.arithmetic->largest());
  EXPECT_DOUBLE_EQ(measured.grid->largest(), errors(found, by_reference({.grid = 0.5})).largest());
}

TEST(Sweep, ErrorsOfAnotherSetting) {
  Setting coarse = usual_setting(Extent::quick);
  coarse.interval = 32;
  const Curves found = by_reference(coarse), exact = in_double(coarse);
  EXPECT_DOUBLE_EQ(point("visibility every 32 steps").arithmetic->largest(), errors(found, exact).largest());
}

// The twin in the engine's format is the engine, so it is as wrong. Double has no error of arithmetic, and
// the reference's own setting has none of the model.
TEST(Sweep, PointsThatMustAgree) {
  const Measured &usual = point("the usual setting"), &twin = point("u16 dithered"), &exact = point("double");
  EXPECT_FALSE(usual.twin);
  EXPECT_TRUE(twin.twin);
  EXPECT_EQ(twin.whole->largest(), usual.whole->largest());
  EXPECT_EQ(twin.arithmetic->largest(), usual.arithmetic->largest());
  EXPECT_EQ(exact.arithmetic->largest(), 0);
  EXPECT_EQ(exact.model->largest(), usual.model->largest());
  EXPECT_EQ(exact.whole->largest(), exact.model->largest());
  const Measured& finest = point("step 1/2, 26 neighbours, 16 rays, visibility every 1");
  EXPECT_EQ(finest.model->largest(), 0);
  EXPECT_EQ(finest.whole->largest(), finest.arithmetic->largest());
  EXPECT_GT(finest.arithmetic->largest(), 0);
}

TEST(Sweep, FormatsAreInTheirOrder) {
  const auto arithmetic = [](const char* name) { return point(name).arithmetic->largest(); };
  EXPECT_GT(arithmetic("u8 dithered"), 10 * arithmetic("u16 dithered"));
  EXPECT_GT(arithmetic("u16 dithered"), 10 * arithmetic("u32 dithered"));
  EXPECT_GT(arithmetic("u16 truncated"), 1.5 * arithmetic("u16 dithered"));
  EXPECT_LT(arithmetic("float"), 0.001);
  EXPECT_EQ(point("u8 dithered").cost.state_bits, 26);
  EXPECT_EQ(point("u16 dithered").cost.state_bits, 50);
  EXPECT_EQ(point("the usual setting").cost.state_bits, 50);
  EXPECT_EQ(point("u32 dithered").cost.state_bits, 98);
  EXPECT_EQ(point("double").cost.state_bits, 194);
}

TEST(Sweep, EachPointHasItsCosts) {
  for (const Measured& one : quick().points) {
    const std::string name = text_of(one.choice);
    EXPECT_GT(one.cost.cells_per_second, 1e5) << name;
    EXPECT_EQ(one.cost.run_seconds.has_value(), !one.twin) << name;
    EXPECT_EQ(one.cost.baseline_cells_per_second.has_value(), !one.twin) << name;
    EXPECT_EQ(one.cost.over_twin > 0, one.twin) << name;
    EXPECT_EQ(one.whole.has_value(), one.choice.axis != Axis::grid) << name;
    EXPECT_EQ(one.grid.has_value(), one.choice.axis == Axis::grid || one.choice.axis == Axis::usual) << name;
  }
  EXPECT_EQ(point("u16 dithered").cost.over_twin, 1);
  EXPECT_GT(quick().seed_error, 0);
}

// Choices that are compared are on one grid. The full set is as large as it says.
TEST(Choices, AreOnOneGridAndMany) {
  std::size_t points = 0;
  std::set<Axis> axes;
  for (const Subject& subject : all_subjects())
    for (const Extent extent : {Extent::quick, Extent::full}) {
      const std::vector<Choice> all = choices(subject, extent);
      const Setting usual = usual_setting(extent);
      EXPECT_EQ(all.front().axis, Axis::usual);
      EXPECT_EQ(all.front().setting, usual);
      EXPECT_EQ(reference_of(subject, extent).grid, usual.grid);
      std::set<std::string> names;
      for (const Choice& choice : all) {
        EXPECT_EQ(choice.setting.grid == usual.grid, choice.axis != Axis::grid) << text_of(choice);
        EXPECT_TRUE(names.insert(text_of(choice)).second) << subject.scene << ": twice " << text_of(choice);
        EXPECT_EQ(choice.setting.arithmetic == kEngine || choice.axis == Axis::format ||
                      choice.axis == Axis::rounding,
                  true);
        if (extent == Extent::full) axes.insert(choice.axis);
      }
      if (extent == Extent::full) points += all.size();
    }
  EXPECT_GE(points, 40u);
  EXPECT_GE(axes.size(), 5u + 2);  // the usual one and several at once are no axes
}

// A choice changes one axis at a time: it departs from the usual setting in nothing else.
TEST(Choices, DepartAlongTheirAxisOnly) {
  for (const Choice& choice : choices(bunny(), Extent::full)) {
    Setting back = choice.setting;
    const Setting usual = usual_setting(Extent::full);
    switch (choice.axis) {
      case Axis::format:
      case Axis::rounding:
        back.arithmetic = usual.arithmetic;
        break;
      case Axis::neighbours:
        back.neighbours = usual.neighbours;
        break;
      case Axis::rays:
        back.rays = usual.rays;
        break;
      case Axis::interval:
        back.interval = usual.interval;
        break;
      case Axis::step:
        back.step = usual.step;
        break;
      case Axis::grid:
        back.grid = usual.grid;
        break;
      case Axis::substeps:
        back.substeps = usual.substeps;
        break;
      case Axis::several:
        continue;
      case Axis::usual:
        break;
    }
    EXPECT_EQ(back, usual) << text_of(choice);
    if (choice.axis != Axis::usual && choice.axis != Axis::rounding) {
      EXPECT_NE(choice.setting, usual) << text_of(choice);
    }
  }
}

}  // namespace
}  // namespace voxmelt::accuracy::front
