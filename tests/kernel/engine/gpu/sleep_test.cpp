// A brick that sleeps on a device stays as it is. In calm worlds small causes wake it: the same as for tiles
// (tests/kernel/engine/parallel). The audit computes what would sleep all the same, and finds no change.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "kernel/engine/gpu/stepper.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "tests/kernel/engine/gpu/hostile_world.h"
#include "tests/kernel/engine/gpu/plain_device.h"
#include "tests/kernel/engine/gpu/same_steps.h"
#include "tests/rounds.h"

namespace voxmelt::gpu {
namespace {

using namespace worlds;

MakeDevice plain(int threads) {
  return [threads](const Parameters&, Grid) { return plain_device(threads); };
}

// Steps a world with the audit, beside the reference.
std::string audited(const HostileWorld& world, int count) {
  gpu::Stepper* device = nullptr;
  const step::Implementation implementation_of{
      "device", "", [&](const Parameters& p, Grid grid, const step::Tuning&) {
        auto stepper = std::make_unique<Stepper>(plain_device(1), p, grid);
        stepper->audit_sleep();
        device = stepper.get();
        return stepper;
      }};
  run::Simulation expected(world.parameters, world.start, implementation("reference"));
  run::Simulation actual(world.parameters, world.start, implementation_of);
  for (int step = 0; step < count; ++step) {
    expected.step();
    actual.step();
    const std::string found = difference(expected.volume(), actual.volume());
    const std::string where = "step " + std::to_string(step) + ": ";
    if (!device->fault().empty()) return where + device->fault();
    if (!found.empty()) return where + found;
    if (expected.ledger() != actual.ledger()) return where + "the books differ";
  }
  return {};
}

class KernelsAsleep : public testing::TestWithParam<rule::Law> {};

TEST_P(KernelsAsleep, WakeInTime) {
  for (int seed = 0; seed < rounds(400); ++seed) {
    const HostileWorld world = calm_world(seed, GetParam());
    if (!same_steps_on_device(world.parameters, world.start, plain(1 + seed % 3), 30, seed % 4 == 1))
      FAIL() << "seed " << seed;
  }
}

TEST_P(KernelsAsleep, StayAsTheyAre) {
  for (int seed = 0; seed < rounds(200); ++seed) {
    const HostileWorld world = seed % 3 == 0   ? hostile_world(seed, GetParam())
                               : seed % 3 == 1 ? sparse_world(seed, GetParam())
                                               : calm_world(seed, GetParam());
    ASSERT_EQ(audited(world, seed % 3 == 0 ? 6 : 16), "") << "seed " << seed;
  }
}

// A shaft across several bricks is emptied from below, filled again so that liquid climbs, and emptied.
TEST(KernelsAsleepAlone, LiquidLeavesABrickAndComesBack) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
    for (const int freezing : {0, 30000}) {
      const Grid grid{34, 18, 3};
      Parameters p = law == rule::Law::paper ? paper_showcase() : viscous(0.1);
      p.heat.enabled = p.heat.air = true;
      p.heat.weight_face = 5000;
      p.heat.air_exchange = 300;
      p.heat.air_temperature.assign(18, 29000);
      p.material = {.melting_point = 30000, .freezing_point = static_cast<rule::Temperature>(freezing)};
      for (const std::uint32_t from : {4u, 44u})
        p.drains.push_back({{{16 * 32 + 8, 8, 24}, 1}, 9000, from, from + 14});
      p.vents.push_back({{{16 * 32 + 8, 8, 24}, 1}, 4096, 50000, 4096, 22, 36});
      Volume start(grid);
      fill_inert(start, whole(grid));
      for_each({32, 0, 1, 33, 18, 2}, [&](int x, int y, int z) {
        start.inert.set(x, y, z, false);
        put(start, x, y, z, y < 11 ? kOne : 0, y < 11 && law == rule::Law::paper ? kOne : 0,
            y < 11 ? 31000 : 0);
      });
      run::Simulation reference = simulate(p, start);
      int changes = 0;
      for (int step = 0, held = 1; step < 62; ++step) {
        reference.step();
        int holds = 0;
        for (int y = 4; y < 8; ++y) holds |= amount_at(reference, 32, y, 1) > 0 ? 1 : 0;
        changes += holds != held ? 1 : 0;
        held = holds;
      }
      EXPECT_GE(changes, freezing == 0 ? 3 : 2) << "it leaves, comes back and leaves";
      EXPECT_TRUE(same_steps_on_device(p, start, plain(1), 62));
      EXPECT_EQ(audited({p, start}, 62), "");
    }
}

// A set drop falls out of a brick in free air. Warm liquid climbs to where it was set, and gives at once.
TEST(KernelsAsleepAlone, AirIsNotSet) {
  Parameters p = paper_showcase();
  p.heat = {};
  p.heat.enabled = true;
  p.material = {.melting_point = 30000, .freezing_point = 30000};
  p.flow.fall = {.factor = 65536, .wall_factor = 65536, .minimum = 0};
  p.flow.paper.threshold = 0;
  p.flow.paper.margin = 1;
  p.vents.push_back({{{16 * 10 + 8, 16 * 3 + 8, 16 * 10 + 8}, 1}, 4096, 50000, 4096, 3, 4});
  Volume start({20, 12, 20});
  fill_inert(start, {0, 0, 0, 20, 3, 20});
  put(start, 10, 4, 10, 2000, 0, 20000);
  for (p.seed = 0; p.seed < 4; ++p.seed) EXPECT_TRUE(same_steps_on_device(p, start, plain(1), 6));
}

// Warm liquid would give more than the step between two cells, so it gives nothing. As it cools, it would
// give less, and may flow.
TEST(KernelsAsleepAlone, WhatCoolsMayFlow) {
  Parameters p = paper_showcase();
  p.flow.paper.threshold = 0;
  p.flow.paper.margin = 1;
  p.flow.paper.share = 13107;
  p.flow.thermal_viscosity = true;
  p.flow.mobility_table.fill(32768);
  std::fill_n(p.flow.mobility_table.begin(), 20, std::uint16_t{2000});
  p.heat.enabled = p.heat.air = true;
  p.heat.air_exchange = 1000;
  p.heat.air_temperature.assign(3, 30000);
  p.material.melting_point = 65535;
  Volume start({4, 3, 3});
  fill_inert(start, {0, 0, 0, 4, 1, 3});
  for (const int x : {1, 2}) {
    start.inert.set(x, 0, 1, false);
    put(start, x, 0, 1, x == 1 ? 4096 : 3900, 3900, 42000);
  }
  EXPECT_TRUE(same_steps_on_device(p, start, plain(1), 20));
}

// A pool that is level and of one temperature rests, and nothing of it is looked at.
TEST(KernelsAsleepAlone, AFlatPoolSleeps) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    Parameters p = law == rule::Law::paper ? paper_showcase() : viscous(0.1);
    p.heat.enabled = true;
    p.heat.weight_face = 5000;
    p.material.melting_point = 20000;
    Volume start({70, 14, 9});
    for_each({0, 0, 0, 70, 6, 9}, [&](int x, int y, int z) {
      put(start, x, y, z, kOne, law == rule::Law::paper ? kOne : 0, 30000);
    });
    Stepper* device = nullptr;
    const step::Implementation watched{
        "device", "", [&](const Parameters& parameters, Grid grid, const step::Tuning&) {
          auto stepper = std::make_unique<Stepper>(plain_device(1), parameters, grid);
          device = stepper.get();
          return stepper;
        }};
    run::Simulation simulation(p, start, watched);
    steps(simulation, 1);
    EXPECT_GT(device->work().with_matter, 10);
    steps(simulation, 3);
    const Stepper::Work rest = device->work();
    EXPECT_EQ(rest.heat + rest.gravity + rest.spread + rest.giving, 0);
  }
}

// Two shafts rest, joined at the bottom alone. One loses some at its top, several bricks above. Then it shows
// another head at the bottom, where nothing else has changed.
TEST(KernelsAsleepAlone, AHeadIsShownFarBelow) {
  Parameters p = viscous(0.3);
  Volume start({14, 16, 3});
  fill_inert(start, whole(start.grid));
  for (const int x : {10, 11, 12})
    for (int y = 0; y < (x == 11 ? 1 : 16); ++y) {
      start.inert.set(x, y, 1, false);
      put(start, x, y, 1, y < 13 ? kOne : y == 13 ? 3000 : 0);
    }
  run::Simulation reference = simulate(p, start);
  steps(reference, 57);
  const Volume before = reference.volume();
  steps(reference, 3);
  EXPECT_EQ(difference(before, reference.volume()), "") << "it rests";
  int top = 15;
  while (amount_at(reference, 10, top, 1) == 0) --top;
  EXPECT_GE(top, 8) << "two bricks above";
  EXPECT_GT(amount_at(reference, 10, top, 1), 1000);
  p.drains.push_back({{{16 * 10 + 8, 16 * top + 8, 24}, 1}, 900, 60, 61});
  EXPECT_TRUE(same_steps_on_device(p, start, plain(1), 75));
}

// A dam breaks behind a wall, so that steps need fewer sub-steps. Beside it a pool sleeps, and shows values
// that fit the former number of sub-steps. Then a vent makes a part of it give.
TEST(KernelsAsleepAlone, SleepersShowWhatFitsTheSubsteps) {
  Parameters p = viscous(0.3);
  p.flow.viscous.substeps = 0;
  Volume start({194, 6, 1});
  fill(start, {0, 0, 0, 3, 6, 1}, kOne);
  for (int y = 0; y < 6; ++y) put_inert(start, 60, y, 0);
  fill(start, {61, 0, 0, 194, 1, 1}, kOne);
  p.vents = {{.region = {{16 * 127 + 8, 8, 8}, 1}, .rate = 4096, .energy = 0, .from = 40}};
  EXPECT_TRUE(same_steps_on_device(p, start, plain(1), 50));
}

// A drop falls in one corner. The bricks there are told, and no others.
TEST(KernelsAsleepAlone, ChangesAreTold) {
  Volume start({130, 40, 40});
  for_each({100, 0, 30, 120, 10, 40}, [&](int x, int y, int z) { put_solid(start, x, y, z, kOne); });
  put(start, 5, 38, 5, kOne);
  run::Simulation simulation(paper_showcase(), start, on_device(plain(1)));
  steps(simulation, 3);
  const state::ChangedBricks::Seen seen = simulation.volume().changed.now();
  steps(simulation, 2);
  const Volume& after = simulation.volume();
  const Grid bricks = state::brick_grid(start.grid);
  int told = 0;
  for_each(whole(bricks), [&](int x, int y, int z) {
    told += after.changed.since(state::ChangedBricks::kMatter, seen, bricks.index(x, y, z)) ? 1 : 0;
  });
  EXPECT_GE(told, 1);
  EXPECT_LE(told, 8 * 2) << "of 64 cells along x, and of two bricks upwards";
}

// A hot drop falls on a solid at the corner of a brick. Only over that corner heat comes to another solid.
TEST(KernelsAsleepAlone, HeatCrossesACorner) {
  Parameters p = paper_showcase();
  p.heat = {};
  p.heat.enabled = true;
  p.heat.neighbours = 26;
  p.heat.weight_face = 10922;
  p.heat.weight_corner = 3640;
  p.material.melting_point = 65535;
  p.flow.paper.threshold = 65535;  // the drop stays on top of it
  p.flow.paper.slump = 0;
  Volume start({64, 20, 8});
  put_solid(start, 31, 3, 3, kOne, 20000);
  put_solid(start, 32, 4, 4, kOne, 20000);
  fill_inert(start, {32, 0, 4, 33, 4, 5});
  put(start, 32, 18, 4, kOne, 0, 60000);
  run::Simulation reference = simulate(p, start);
  steps(reference, 30);
  EXPECT_GT(reference.volume().heat[start.at(31, 3, 3)], 20000);
  EXPECT_TRUE(same_steps_on_device(p, start, plain(1), 30));
}

// Runs a scene to a part of its melt, and then some steps on a device. It returns the sums of their work.
Stepper::Work work_in(const std::string& name, int eighths) {
  const scene::Scene scene = scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (name + ".toml"), {});
  const int steps_before = static_cast<int>(scene.steps) * eighths / 8;
  run::Simulation fast(scene.parameters, scene.initial, run::implementations().widest(), {.threads = 2});
  steps(fast, steps_before);
  Stepper* device = nullptr;
  const step::Implementation counted{"device", "", [&](const Parameters& p, Grid grid, const step::Tuning&) {
                                       auto stepper = std::make_unique<Stepper>(plain_device(2), p, grid);
                                       device = stepper.get();
                                       return stepper;
                                     }};
  run::Simulation simulation(scene.parameters, fast.volume(), counted);
  simulation.begin_at(static_cast<std::uint32_t>(steps_before));
  Stepper::Work sum;
  for (int step = 0; step < 6; ++step) {
    simulation.step();
    if (step < 2) continue;  // nothing is known about the first state
    const Stepper::Work one = device->work();
    sum.with_matter += one.with_matter;
    sum.beside_matter += one.beside_matter;
    sum.heat += one.heat;
    sum.gravity += one.gravity;
    sum.spread += one.spread;
    sum.giving += one.giving;
  }
  return sum;
}

// Without sleep, spread would visit all bricks that hold matter, and those beside them: twice under the
// paper's law.
TEST(BricksAwake, AreFewInScenes) {
  for (const std::string name :
       {"cello", "goblet", "lava", "bunny", "cello_viscous", "goblet_viscous", "lava_viscous", "candle"}) {
    if (!all_rounds() && name != "cello") continue;
    Stepper::Work sum;
    for (const int eighths : {2, 4, 6}) {
      if (!all_rounds() && eighths != 4) continue;
      const Stepper::Work one = work_in(name, eighths);
      std::printf("%s %d/8: matter %d, beside %d, heat %d, gravity %d, spread %d, giving %d\n", name.c_str(),
                  eighths, one.with_matter / 4, one.beside_matter / 4, one.heat / 4, one.gravity / 4,
                  one.spread / 4, one.giving / 4);
      sum.beside_matter += one.beside_matter;
      sum.spread += one.spread;
      sum.giving += one.giving;
    }
    EXPECT_GT(sum.giving, 0) << name;
    EXPECT_LT(sum.giving, sum.beside_matter) << name;
    const bool viscous_law = name.ends_with("_viscous") || name == "candle";
    if (viscous_law)  // one kernel, and what it has changed is brought back
      EXPECT_LE(sum.spread, sum.beside_matter) << name;
    else
      EXPECT_LT(3 * (sum.spread + sum.giving), 4 * sum.beside_matter)
          << name << ": it would be 6 without sleep";
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, KernelsAsleep, testing::Values(rule::Law::paper, rule::Law::viscous),
                         [](const auto& law) { return law.param == rule::Law::paper ? "paper" : "viscous"; });

}  // namespace
}  // namespace voxmelt::gpu
