// The quick sweep of a scene is held against runs that the test makes itself.
#include "accuracy/front/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "accuracy/front/depth_map.h"
#include "accuracy/front/pick.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

namespace voxmelt::accuracy::front {
namespace {

const Subject& bunny() { return all_subjects()[3]; }
const Subject& viscous_bunny() { return all_subjects()[7]; }

scene::Scene load(const Subject& subject, const Setting& setting, const std::string& more = "run.steps=1") {
  std::vector<std::string> sets = subject.sets(setting);
  sets.push_back(more);
  return scene::load(VOXMELT_SCENES_FOLDER "/" + subject.scene + ".toml", sets);
}

struct Ended {
  Curves curves;
  DepthMap map;
};
Ended run_of(const Subject& subject, const Setting& setting, const step::Implementation& implementation,
             const std::string& more = "run.steps=1") {
  const scene::Scene scene = load(subject, setting, more);
  run::Simulation simulation(scene.parameters, scene.initial, implementation);
  Curves curves;
  for (std::uint32_t i = 1; i <= subject.samples; ++i) {
    while (simulation.steps_done() < subject.steps_to(setting, i)) simulation.step();
    curves.push_back(sample_of(simulation.volume(), subject.scale(setting)));
  }
  return {curves, map_of(simulation.volume(), setting.grid)};
}
const step::Implementation& widest() { return run::implementations().widest(); }

Curves by_twin(const Setting& setting) {
  const scene::Scene scene = load(bunny(), setting);
  const std::unique_ptr<Twin> twin = make_twin(setting.arithmetic, scene.parameters, scene.initial);
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
    conditions.implementation = &widest();
    conditions.scenes = VOXMELT_SCENES_FOLDER;
    return sweep(bunny(), Extent::quick, conditions, [] {});
  }();
  return swept;
}

const Measured& point(Axis axis, const std::string& text) {
  for (const Measured& one : quick().points)
    if (one.axis == axis && text_of(one.axis, one.setting) == text) return one;
  ADD_FAILURE() << "no point " << text;
  return quick().points.front();
}

void expect_difference(const Measured& measured, const Ended& found, const Ended& reference) {
  for (const auto curve : kCurves)
    EXPECT_DOUBLE_EQ(measured.difference.curves.*curve, errors(found.curves, reference.curves).*curve);
  EXPECT_DOUBLE_EQ(measured.difference.map, part_elsewhere(found.map, reference.map));
  EXPECT_GT(measured.difference.map, 0);
}

// Each axis has its own reference. The usual run is computed by the slowest implementation.
void expect_errors_along_the_axes() {
  const Setting usual = usual_setting(Extent::quick);
  const auto with = [&](auto Setting::*what, auto value) {
    Setting setting = usual;
    setting.*what = value;
    return run_of(bunny(), setting, widest());
  };
  const Ended run = run_of(bunny(), usual, *run::implementations().find("reference"));
  expect_difference(point(Axis::step, "step x 1"), run, with(&Setting::step, 0.5));
  expect_difference(point(Axis::rays, "rays_per_face = 1"), run, with(&Setting::rays, 16));
  expect_difference(point(Axis::visibility, "visibility_every = 8"), with(&Setting::interval, 8), run);
  expect_difference(point(Axis::grid, "grid 0.25"), with(&Setting::grid, 0.25), run);
  expect_difference(point(Axis::neighbours, "neighbours = 26"), with(&Setting::neighbours, 26), run);
}

TEST(Sweep, TheErrorIsTheLargestOfCurvesAndMap) {
  const Difference curves{{0.1, 0, 0.3, 0}, 0.2}, map{{0.1, 0, 0, 0}, 0.2};
  EXPECT_EQ(curves.error(), 0.3);
  EXPECT_EQ(map.error(), 0.2);
}

// The noise is the largest difference between the usual run and one with another seed.
void expect_noise_of_three_seeds() {
  const Setting usual = usual_setting(Extent::quick);
  const Ended own = run_of(bunny(), usual, widest());
  Noise noise;
  for (const char* seed : {"run.seed=1001", "run.seed=1002", "run.seed=1003"}) {
    const Ended other = run_of(bunny(), usual, widest(), seed);
    noise.curves = std::max(noise.curves, errors(other.curves, own.curves).largest());
    noise.map = std::max(noise.map, part_elsewhere(other.map, own.map));
  }
  EXPECT_GT(noise.curves, 0);
  EXPECT_GT(noise.map, 0);
  EXPECT_DOUBLE_EQ(quick().noise.curves, noise.curves);
  EXPECT_DOUBLE_EQ(quick().noise.map, noise.map);
}

// The sweep takes it for granted that nothing is random under the viscous law.
TEST(Sweep, TheViscousLawHasNoNoise) {
  const Setting small{.grid = 0.25};
  const Ended own = run_of(viscous_bunny(), small, widest()),
              other = run_of(viscous_bunny(), small, widest(), "run.seed=1001");
  EXPECT_EQ(errors(other.curves, own.curves).largest(), 0);
  EXPECT_EQ(part_elsewhere(other.map, own.map), 0);
  EXPECT_FALSE(own.map.empty());
}

void expect_references_and_times() {
  for (const Measured& one : quick().points) {
    const std::string name = text_of(one.axis, one.setting);
    EXPECT_GT(one.seconds, 1e-4) << name;
    EXPECT_EQ(one.difference.error() == 0, one.reference) << name;
    if (one.setting == quick().usual) {
      EXPECT_EQ(one.seconds, quick().usual_seconds) << name;
    }
  }
}

void expect_picks_of_the_points() {
  ASSERT_EQ(quick().picks.size(), std::size(kBounds));
  for (std::size_t i = 0; i < quick().picks.size(); ++i) {
    const Pick wanted = pick(quick().points, quick().usual, quick().noise, kBounds[i]);
    EXPECT_EQ(quick().picks[i].setting, wanted.setting);
    EXPECT_EQ(quick().picks[i].sum, wanted.sum);
    EXPECT_GT(quick().picks[i].seconds, 0);
  }
}

// The twin in the engine's format is the engine. Formats are told beside double.
void expect_formats_in_their_order() {
  const auto format = [](const std::string& name) {
    for (const Format& one : quick().formats)
      if (name_of(one.arithmetic) == name) return one;
    ADD_FAILURE() << name;
    return Format{};
  };
  Setting exact = setting_of_formats();
  exact.arithmetic = kExact;
  const Ended engine = run_of(bunny(), setting_of_formats(), widest());
  EXPECT_DOUBLE_EQ(format("u16 dithered").error, errors(engine.curves, by_twin(exact)).largest());
  EXPECT_GT(format("u8 dithered").error, 10 * format("u16 dithered").error);
  EXPECT_GT(format("u16 dithered").error, 10 * format("u32 dithered").error);
  EXPECT_GT(format("u16 truncated").error, 1.5 * format("u16 dithered").error);
  EXPECT_LT(format("float").error, 0.001);
  EXPECT_EQ(format("u8 dithered").state_bits, 26);
  EXPECT_EQ(format("u16 dithered").state_bits, 50);
  EXPECT_EQ(format("u32 dithered").state_bits, 98);
}

// It is one test, because a process of its own would sweep anew for each.
TEST(Sweep, OfTheBunny) {
  expect_errors_along_the_axes();
  expect_noise_of_three_seeds();
  expect_references_and_times();
  expect_picks_of_the_points();
  expect_formats_in_their_order();
}

}  // namespace
}  // namespace voxmelt::accuracy::front
