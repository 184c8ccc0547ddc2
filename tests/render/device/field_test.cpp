// The field on a device has the numbers of the field on the host, cell by cell, in hostile worlds, in worlds
// like scenes, and in scenes in the middle of their melt: with kernels as C++, and on a device of OpenCL.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/engine/gpu/stepper.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "render/density/density_field.h"
#include "render/device/device_field.h"
#include "tests/kernel/engine/gpu/hostile_world.h"
#include "tests/render/device/devices.h"
#include "tests/rounds.h"

namespace voxmelt::render {
namespace {

using worlds::Random;

// Returns where the two differ first, or nothing.
template <class A, class B>
std::string difference(const A& expected, const B& actual) {
  if (expected.size() != actual.size()) return "another size";
  for (std::size_t i = 0; i < actual.size(); ++i)
    if (expected[i] != actual[i])
      return "number " + std::to_string(i) + ": " + std::to_string(expected[i]) + " is " +
             std::to_string(actual[i]);
  return {};
}

bool same_field(const DeviceField& actual, const state::Volume& volume, const scene::Look& look,
                const scene::Terrain& terrain, const std::string& what) {
  DensityField expected;
  expected.update(volume, look, terrain);
  bool same = true;
  const auto check = [&](const char* name, const std::string& found) {
    if (found.empty()) return;
    ADD_FAILURE() << what << ", " << name << ": " << found;
    same = false;
  };
  check("intensity", difference(expected.intensity(), actual.fetch(0)));
  check("solid", difference(expected.solid(), actual.fetch(1)));
  check("liquid", difference(expected.liquid(), actual.fetch(2)));
  check("obstacle", difference(expected.has_obstacles() ? expected.obstacle()
                                                        : Values<std::uint16_t>(volume.grid.cells()),
                               actual.fetch(3)));
  check("heat", difference(expected.heat(), actual.fetch(4)));
  check("ground", difference(expected.ground(), actual.fetch_ground()));
  check("wetness", difference(expected.wetness(), actual.fetch_wetness()));
  return same;
}

bool same_field(const OnDevice& on, const rule::Parameters& parameters, const state::Volume& volume,
                const scene::Look& look, const scene::Terrain& terrain, const std::string& what) {
  gpu::Stepper stepper(on.device, parameters, volume.grid);
  stepper.upload(volume, {});
  DeviceField field(on.kernels);
  field.update(stepper.where(), look, terrain);
  return same_field(field, volume, look, terrain, what);
}

// Any look that matters to the field.
scene::Look any_look(Random& random, bool glows) {
  scene::Look look;
  look.smooth = random.below(7);
  look.smooth_solid = random.below(7);
  look.glow = glows && random.one_in(2);
  if (!look.glow && random.one_in(2))
    for (int m = random.between(2, 16); m > 0; --m)
      look.materials.push_back({random.below(5) / 4.0, random.below(5) / 4.0, random.below(5) / 4.0});
  return look;
}
// A terrain that fits or does not, or none.
scene::Terrain any_terrain(Random& random, const state::Grid& grid) {
  scene::Terrain terrain;
  if (random.one_in(2)) return terrain;
  terrain.x = grid.x + (random.one_in(8) ? 1 : 0);
  terrain.z = grid.z;
  for (int c = terrain.x * terrain.z; c > 0; --c)
    terrain.height.push_back(static_cast<float>(random.between(-3, 4 * grid.y + 3)) / 4);
  return terrain;
}

bool same_in_hostile_world(int seed, const OnDevice& on) {
  const worlds::HostileWorld world =
      worlds::hostile_world(seed, seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous);
  Random random(static_cast<std::uint64_t>(seed) + 77);
  const scene::Look look = any_look(random, world.parameters.heat.enabled);
  return same_field(on, world.parameters, world.start, look, any_terrain(random, world.start.grid),
                    "seed " + std::to_string(seed));
}

// Uneven ground with puddles and lumps on it, so that levels are smoothed and the ground is filled.
bool same_in_landscape(int seed, const OnDevice& on) {
  Random random(static_cast<std::uint64_t>(seed) + 5);
  const state::Grid grid{random.between(1, 40), random.between(2, 24), random.between(1, 30)};
  state::Volume volume(grid);
  const int slope = random.between(0, grid.y / 2), dry = random.below(3), deep = random.between(1, 4);
  for (int z = 0; z < grid.z; ++z)
    for (int x = 0; x < grid.x; ++x) {
      const int bed = std::min(grid.y, random.below(2) + 1 + (x + z) * slope / (grid.x + grid.z));
      for (int y = 0; y < bed; ++y) {
        worlds::put_inert(volume, x, y, z, random.below(4097));
      }
      if (dry > 0 && (x / 7 + z / 5) % 3 < dry) continue;
      for (int y = bed; y < std::min(grid.y, bed + deep - random.below(2)); ++y)
        worlds::put(volume, x, y, z, random.between(1, 4096), 0, random.below(65536));
    }
  for (int k = random.below(4); k > 0; --k) {
    const int x = random.below(grid.x), y = random.below(grid.y), z = random.below(grid.z);
    if (volume.amount[volume.at(x, y, z)] == 0) worlds::put_inert(volume, x, y, z);
  }
  rule::Parameters parameters;
  parameters.heat.enabled = true;
  return same_field(on, parameters, volume, any_look(random, true), any_terrain(random, grid),
                    "seed " + std::to_string(seed));
}

TEST(KernelsOfTheField, SameInHostileWorlds) {
  for (int seed = 0; seed < rounds(300); ++seed)
    if (!same_in_hostile_world(seed, plain(1 + seed % 3))) FAIL();
}

TEST(KernelsOfTheField, SameInLandscapes) {
  for (int seed = 0; seed < rounds(300); ++seed)
    if (!same_in_landscape(seed, plain(1 + seed % 3))) FAIL();
}

TEST(OpenClField, SameInHostileWorlds) {
  VOXMELT_NEEDS_A_DEVICE();
  for (int seed = 0; seed < rounds(300); ++seed)
    if (!same_in_hostile_world(seed, open_cl())) FAIL();
}

TEST(OpenClField, SameInLandscapes) {
  VOXMELT_NEEDS_A_DEVICE();
  for (int seed = 0; seed < rounds(300); ++seed)
    if (!same_in_landscape(seed, open_cl())) FAIL();
}

// The field follows the state of a device that steps, in scenes in the middle of their melt.
TEST(OpenClField, SameInScenes) {
  VOXMELT_NEEDS_A_DEVICE();
  std::vector<std::string> names{"lava", "chocolate_nuts"};
  if (all_rounds()) names.insert(names.end(), {"cello", "bunny_small", "goblet_viscous", "ice"});
  for (const std::string& name : names) {
    const scene::Scene scene =
        scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (name + ".toml"), {});
    run::Simulation fast(scene.parameters, scene.initial, run::implementations().widest(), {.threads = 2});
    const std::uint32_t middle = all_rounds() ? scene.steps / 3 : 40;
    while (fast.steps_done() < middle) fast.step();
    state::Volume volume = fast.volume();
    state::Ledger ledger = fast.ledger();
    gpu::Stepper stepper(open_cl().device, scene.parameters, volume.grid);
    stepper.upload(volume, ledger);
    DeviceField field(open_cl().kernels);
    for (int step = 0; step < 2; ++step) {
      if (stepper.follows_rays(scene.parameters.heat) && scene.parameters.heat.is_visibility_step(middle))
        stepper.find_irradiance(middle);
      if (step > 0) stepper.run_step(middle + static_cast<std::uint32_t>(step), nullptr);
      stepper.download(volume, ledger);
      field.update(stepper.where(), scene.look, scene.terrain);
      ASSERT_TRUE(
          same_field(field, volume, scene.look, scene.terrain, name + " after " + std::to_string(step)));
    }
  }
}

}  // namespace
}  // namespace voxmelt::render
