// A scene's keys change as they must on other grids and with other steps.
#include "accuracy/front/subject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "kernel/scene/scene.h"

namespace voxmelt::accuracy::front {
namespace {

scene::Scene load(const Subject& subject, const std::vector<std::string>& sets) {
  return scene::load(std::string(VOXMELT_SCENES_FOLDER "/") + subject.scene + ".toml", sets);
}

const Subject& named(const std::string& scene) {
  for (const Subject& subject : all_subjects())
    if (subject.scene == scene) return subject;
  ADD_FAILURE() << scene;
  return all_subjects().front();
}

// On the scene's own grid nothing changes but the floor, which is one cell thinner, and all heights with it.
TEST(Subject, GridOneIsTheScenesFile) {
  for (const Subject& subject : all_subjects()) {
    const rule::Parameters own = load(subject, {}).parameters,
                           found = load(subject, subject.sets({.grid = 1})).parameters;
    EXPECT_EQ(found.heat.weight_face, own.heat.weight_face) << subject.scene;
    EXPECT_EQ(found.heat.convection, own.heat.convection) << subject.scene;
    EXPECT_EQ(found.heat.air_exchange, own.heat.air_exchange) << subject.scene;
    EXPECT_EQ(found.flow.paper.share, own.flow.paper.share) << subject.scene;
    EXPECT_EQ(found.flow.paper.alpha_floor, own.flow.paper.alpha_floor) << subject.scene;
    EXPECT_EQ(found.flow.fall.wall_factor, own.flow.fall.wall_factor) << subject.scene;
    EXPECT_EQ(found.flow.viscous.mobility, own.flow.viscous.mobility) << subject.scene;
    EXPECT_EQ(found.flow.viscous.yield, own.flow.viscous.yield) << subject.scene;
    if (subject.viscous) {
      EXPECT_EQ(found.flow.viscous.substeps_max, 64) << subject.scene;  // as if the file said nothing
    }
    EXPECT_EQ(found.flow.viscous.stages_max, own.flow.viscous.stages_max) << subject.scene;
    ASSERT_EQ(found.heat.sources.size(), own.heat.sources.size());
    for (std::size_t i = 0; i < own.heat.sources.size(); ++i) {
      EXPECT_EQ(found.heat.sources[i].keys[0].power, own.heat.sources[i].keys[0].power) << subject.scene;
      EXPECT_EQ(found.heat.sources[i].keys[0].at.x, own.heat.sources[i].keys[0].at.x) << subject.scene;
      EXPECT_EQ(found.heat.sources[i].keys[0].at.y, own.heat.sources[i].keys[0].at.y - 16) << subject.scene;
    }
    ASSERT_EQ(found.vents.size(), own.vents.size());
    for (std::size_t i = 0; i < own.vents.size(); ++i) {
      EXPECT_EQ(found.vents[i].rate, own.vents[i].rate);
      EXPECT_EQ(found.vents[i].region.radius, own.vents[i].region.radius);
      EXPECT_EQ(found.vents[i].until, own.vents[i].until);
    }
  }
}

// Cells are twice as large and steps twice as long: dt = 2 and dx = 2.
TEST(Subject, HalfTheGrid) {
  const Setting half{.grid = 0.5};
  const auto near = [](double found, double wanted) { EXPECT_NEAR(found, wanted, 1 + wanted / 1000); };
  const rule::Parameters cello = load(named("cello"), {}).parameters,
                         small = load(named("cello"), named("cello").sets(half)).parameters;
  near(small.heat.weight_face, cello.heat.weight_face / 2.);  // dt / dx^2
  const double power = static_cast<double>(cello.heat.sources[0].keys[0].power);
  near(static_cast<double>(small.heat.sources[0].keys[0].power) / power * 1e6, 1e6 / 4);  // dt / dx^3
  EXPECT_EQ(small.flow.paper.share, cello.flow.paper.share);
  const rule::Parameters lava = load(named("lava"), {}).parameters,
                         low = load(named("lava"), named("lava").sets(half)).parameters;
  EXPECT_EQ(lava.heat.air_exchange, 98);
  // That of the surface goes by dt / dx, and stays 0.0017. Half a cell behind it conducts 0.02 / pi, half as
  // much: 0.0017 / (1 + 0.0017 / 0.0063662) = 87.9 / 65536.
  EXPECT_EQ(low.heat.air_exchange, 88);
  near(low.vents[0].rate, lava.vents[0].rate * 2.);  // dt
  EXPECT_EQ(low.vents[0].until, 1200u);
  const rule::Parameters viscous = load(named("cello_viscous"), {}).parameters,
                         slow = load(named("cello_viscous"), named("cello_viscous").sets(half)).parameters;
  near(static_cast<double>(slow.flow.viscous.mobility),
       static_cast<double>(viscous.flow.viscous.mobility) * 4);
  EXPECT_EQ(named("cello").steps_to(half, 1), 56u);
  EXPECT_EQ(named("cello").scale(half).grid, 0.5);
}

// The body fills the same part of the grid, and has the same volume in the scene's cells.
TEST(Subject, BodiesScaleWithTheGrid) {
  for (const char* name : {"goblet", "bunny"}) {
    const Subject& subject = named(name);
    const auto height_and_volume = [&](double grid) {
      const state::Volume v = load(subject, subject.sets({.grid = grid})).initial;
      double mass = 0;
      int top = 0;
      for (int z = 0; z < v.grid.z; ++z)
        for (int y = 0; y < v.grid.y; ++y)
          for (int x = 0; x < v.grid.x; ++x)
            if (v.solid.test(x, y, z)) {
              mass += v.amount[v.at(x, y, z)] / 4096.;
              top = std::max(top, y);
            }
      return std::pair{(top + 1 - 1) / grid, mass / (grid * grid * grid)};
    };
    const auto [tall, large] = height_and_volume(1);
    const auto [as_tall, as_large] = height_and_volume(0.5);
    EXPECT_NEAR(as_tall, tall, 2.5) << name;
    EXPECT_NEAR(as_large / large, 1, 0.05) << name;
  }
}

// Half a step has half of the heat, half of what falls and spreads, and twice the steps.
TEST(Subject, HalfAStep) {
  const Subject& bunny = named("bunny");
  const rule::Parameters whole = load(bunny, bunny.sets({})).parameters,
                         half = load(bunny, bunny.sets({.step = 0.5})).parameters;
  EXPECT_NEAR(half.heat.weight_face, whole.heat.weight_face / 2., 1);
  EXPECT_EQ(half.flow.fall.factor, 32768u);
  EXPECT_EQ(half.flow.fall.wall_factor, whole.flow.fall.wall_factor / 2);
  EXPECT_EQ(half.flow.paper.share, whole.flow.paper.share / 2);
  EXPECT_NEAR(half.flow.paper.alpha_floor, 65536 * std::sqrt(0.92), 1);
  EXPECT_EQ(bunny.steps_to({.step = 0.5}, 2), 2 * bunny.steps_to({}, 2));
}

// With n times the conductors each must conduct less. The sum of 2 x weight x (distance along an axis)^2 over
// all pairs is the diffusivity. Faces count 1, the 4 edges that move along an axis 1 each, the 4 corners too.
TEST(Subject, NeighboursKeepTheDiffusivity) {
  const Subject& goblet = named("goblet");
  const auto diffusivity = [&](int neighbours) {
    const rule::Heat heat = load(goblet, goblet.sets({.neighbours = neighbours})).parameters.heat;
    return heat.weight_face + (neighbours >= 18 ? 4 * heat.weight_edge : 0) +
           (neighbours >= 26 ? 4 * heat.weight_corner : 0);
  };
  EXPECT_NEAR(diffusivity(18), diffusivity(6), 5);
  EXPECT_NEAR(diffusivity(26), diffusivity(6), 9);
}

}  // namespace
}  // namespace voxmelt::accuracy::front
