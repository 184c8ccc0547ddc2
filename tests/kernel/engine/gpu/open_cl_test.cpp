// Devices of OpenCL give the bits and the books of the reference. Where a machine has no device, PoCL runs
// the kernels on its processor; without any, these tests say so and are skipped.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "kernel/automaton/state/digest.h"
#include "kernel/engine/gpu/open_cl.h"
#include "kernel/scene/scene.h"
#include "tests/kernel/engine/gpu/hostile_world.h"
#include "tests/kernel/engine/gpu/same_light.h"
#include "tests/kernel/engine/scene_names.h"
#include "tests/rounds.h"

namespace voxmelt::gpu {
namespace {

using namespace worlds;

#define VOXMELT_NEEDS_A_DEVICE() \
  if (open_cl_devices().empty()) GTEST_SKIP() << "no device of OpenCL here (Debian: pocl-opencl-icd)"

// One program serves all worlds: its compiler takes seconds.
std::shared_ptr<Device> any_scene(const Parameters&, Grid) {
  static const std::shared_ptr<Device> device = open(open_cl_devices().front(), nullptr);
  return device;
}
std::shared_ptr<Device> this_scene(const Parameters& parameters, Grid grid) {
  const Constants constants = constants_of(parameters, Shape(grid));
  return open(open_cl_devices().front(), &constants);
}

// Every scene, from its start and from the middle of its melt. A third of them is quick.
TEST(OpenClScenes, HaveTheDigestsAndTheBooks) {
  VOXMELT_NEEDS_A_DEVICE();
  const int count = all_rounds() ? 60 : 4;
  for (const std::string& name : some_of(scene_names(VOXMELT_SCENES_FOLDER))) {
    const scene::Scene scene =
        scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (name + ".toml"), {});
    run::Simulation fast(scene.parameters, scene.initial, run::implementations().widest(), {.threads = 2});
    for (const bool from_the_middle : {false, true}) {
      if (from_the_middle) steps(fast, static_cast<int>(scene.steps) / 3);
      const Volume start = fast.volume();
      run::Simulation expected(scene.parameters, start, run::implementations().widest(), {.threads = 2});
      run::Simulation actual(scene.parameters, start, on_device(any_scene));
      steps(expected, count);
      steps(actual, count);
      ASSERT_EQ(state::digest(actual.volume()), state::digest(expected.volume())) << name;
      ASSERT_TRUE(actual.ledger() == expected.ledger()) << name << ": the books differ";
    }
  }
}

// It is what `voxmelt bench` holds steps against, so it must not leave out a word.
TEST(OpenClCopy, CopiesAsManyWordsAsAsked) {
  VOXMELT_NEEDS_A_DEVICE();
  const std::shared_ptr<Device> device = any_scene({}, {});
  std::vector<std::uint32_t> from(2000), to(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<std::uint32_t>(1 + 3 * i);
  const std::size_t bytes = from.size() * sizeof(std::uint32_t);
  for (const int groups : {1, 3, 100}) {
    const auto here = device->allocate(bytes), there = device->allocate(bytes);
    device->write(*here, from.data(), bytes);
    device->run(Kernel::copy_words, groups, {here.get(), there.get(), 1777});
    device->read(*there, to.data(), bytes);
    for (std::size_t i = 0; i < to.size(); ++i)
      ASSERT_EQ(to[i], i < 1777 ? from[i] : 0) << "word " << i << ", " << groups << " groups";
  }
}

TEST(OpenClLight, SameIrradianceOfEveryCell) {
  VOXMELT_NEEDS_A_DEVICE();
  Lights all;
  for (int seed = 0; seed < rounds(300); ++seed)
    if (!same_light_on_device(seed, nullptr, any_scene, all)) FAIL();
  EXPECT_GT(all.lit, 1000);
  EXPECT_GT(all.capped, 100);
}

// Each program has the rays of one kind alone.
TEST(OpenClLight, SameIrradianceByAProgramForOneScene) {
  VOXMELT_NEEDS_A_DEVICE();
  Lights all;
  for (const rule::SourceKindRow& kind : rule::kSourceKinds)
    for (int seed = 0; seed < rounds(3); ++seed)
      if (!same_light_on_device(1000 + seed, &kind, this_scene, all)) FAIL() << kind.name;
}

class OpenCl : public testing::TestWithParam<rule::Law> {};

TEST_P(OpenCl, SameBitsInHostileWorlds) {
  VOXMELT_NEEDS_A_DEVICE();
  for (int seed = 0; seed < rounds(600); ++seed) {
    const HostileWorld world = hostile_world(seed, GetParam());
    if (!same_steps_on_device(world.parameters, world.start, any_scene, 6, seed % 4 == 1))
      FAIL() << "seed " << seed;
  }
}

TEST_P(OpenCl, SameBitsWhereMostBricksAreEmpty) {
  VOXMELT_NEEDS_A_DEVICE();
  for (int seed = 0; seed < rounds(30); ++seed) {
    const HostileWorld world = sparse_world(seed, GetParam());
    if (!same_steps_on_device(world.parameters, world.start, any_scene, 14, seed % 4 == 1, seed % 3 > 0))
      FAIL() << "seed " << seed;
  }
}

TEST_P(OpenCl, SleepersWakeInTime) {
  VOXMELT_NEEDS_A_DEVICE();
  for (int seed = 0; seed < rounds(120); ++seed) {
    const HostileWorld world = calm_world(seed, GetParam());
    if (!same_steps_on_device(world.parameters, world.start, any_scene, 30, seed % 4 == 1))
      FAIL() << "seed " << seed;
  }
}

TEST_P(OpenCl, SameBitsByAProgramForOneScene) {
  VOXMELT_NEEDS_A_DEVICE();
  for (int seed = 0; seed < rounds(3); ++seed) {
    const HostileWorld world = hostile_world(1000 + seed, GetParam());
    if (!same_steps_on_device(world.parameters, world.start, this_scene, 6)) FAIL() << "seed " << seed;
  }
}

// A device that waits for a moment only counts as lost, and says so.
TEST(OpenClDevice, ThatDoesNotAnswerIsLost) {
  VOXMELT_NEEDS_A_DEVICE();
  EXPECT_EXIT(
      {
        try {
          const std::unique_ptr<Device> device = open(open_cl_devices().front(), nullptr, {.answer = 0});
          const std::unique_ptr<Memory> memory = device->allocate(std::size_t{1} << 28);
          std::vector<char> all(std::size_t{1} << 28);
          device->read(*memory, all.data(), all.size());
        } catch (const DeviceError& error) {
          std::fputs(error.what(), stderr);
          std::_Exit(5);
        }
      },
      testing::ExitedWithCode(5), "does not answer for 0 s$");
}

// The same holds while it builds its program. With a spare, as `auto` has one, the processor goes on.
TEST(OpenClDevice, ThatBuildsForEverIsLostAndTheSpareGoesOn) {
  VOXMELT_NEEDS_A_DEVICE();
  const HostileWorld world = hostile_world(2, rule::Law::paper);
  const auto go_on = [&world] {
    step::Implementation device =
        on_device([](const Parameters& parameters, Grid grid) -> std::shared_ptr<Device> {
          const Constants constants = constants_of(parameters, Shape(grid));
          return open(open_cl_devices().front(), &constants, {.build = 0});
        });
    device.spare = &implementation("reference");
    device.told = [](const DeviceError& why) { std::fputs(why.what(), stderr); };
    run::Simulation expected(world.parameters, world.start, implementation("reference"));
    run::Simulation actual(world.parameters, world.start, device);
    steps(expected, 3);
    steps(actual, 3);
    const bool same = difference(expected.volume(), actual.volume()).empty();
    std::_Exit(same && step::DeviceLost::happened && actual.implementation() == "reference" ? 5 : 6);
  };
  EXPECT_EXIT(go_on(), testing::ExitedWithCode(5), "does not answer for 0 s while it builds a program$");
}

INSTANTIATE_TEST_SUITE_P(Laws, OpenCl, testing::Values(rule::Law::paper, rule::Law::viscous),
                         [](const auto& law) { return law.param == rule::Law::paper ? "paper" : "viscous"; });

}  // namespace
}  // namespace voxmelt::gpu
