// Every committed scene gives the digests of the reference, step by step. This holds for every
// implementation, for threads and tile sizes, asleep and awake. Each scene runs twice: from its start, and
// from the middle of its melt, where everything moves.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/automaton/state/digest.h"
#include "kernel/scene/scene.h"
#include "tests/kernel/engine/parallel/equal.h"
#include "tests/kernel/engine/scene_names.h"

namespace voxmelt::parallel {
namespace {

using namespace worlds;

struct Case {
  std::string implementation;
  step::Tuning tuning;
};

// Returns each instruction set, and each way to work with the fastest one.
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::string& name : fast_implementations()) all.push_back({name, {.threads = 1}});
  const std::string fastest = fast_implementations().back();
  for (const int threads : {2, 3})
    for (const bool sleep : {true, false})
      for (const int tile_shift : {1, 3, 6})
        all.push_back({fastest, {.threads = threads, .sleep = sleep, .tile_shift = tile_shift}});
  return all;
}

void compare(const Parameters& parameters, const Volume& start, int steps) {
  std::vector<std::uint64_t> expected;
  run::Simulation reference(parameters, start, implementation("reference"));
  for (int i = 0; i < steps; ++i) {
    reference.step();
    expected.push_back(state::digest(reference.volume()));
  }
  for (const Case& one : cases()) {
    run::Simulation fast(parameters, start, implementation(one.implementation), one.tuning);
    for (int i = 0; i < steps; ++i) {
      fast.step();
      ASSERT_EQ(state::digest(fast.volume()), expected[static_cast<std::size_t>(i)])
          << one.implementation << ", threads " << one.tuning.threads << ", sleep " << one.tuning.sleep
          << ", tile_shift " << one.tuning.tile_shift << ", step " << i;
    }
    ASSERT_TRUE(fast.ledger() == reference.ledger()) << "the books differ: " << one.implementation;
  }
}

class Scenes : public testing::TestWithParam<std::string> {
 protected:
  scene::Scene load() const {
    return scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (GetParam() + ".toml"), {});
  }
};

#ifdef VOXMELT_SLOW
constexpr int kSteps = 300;
#else
constexpr int kSteps = 20;
#endif

TEST_P(Scenes, FromTheStart) {
  const scene::Scene scene = load();
  compare(scene.parameters, scene.initial, kSteps);
}

TEST_P(Scenes, InTheMiddleOfTheMelt) {
  const scene::Scene scene = load();
  run::Simulation fast(scene.parameters, scene.initial, run::implementations().widest(), {.threads = 2});
  steps(fast, static_cast<int>(scene.steps) / 3);
  compare(scene.parameters, fast.volume(), kSteps / 5);
}

INSTANTIATE_TEST_SUITE_P(Committed, Scenes, testing::ValuesIn(scene_names(VOXMELT_SCENES_FOLDER)),
                         [](const auto& chosen) { return chosen.param; });

}  // namespace
}  // namespace voxmelt::parallel
