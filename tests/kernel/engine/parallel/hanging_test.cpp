// Nothing hangs in the air in a scene with [pieces], at any step.
#include "tests/kernel/engine/parallel/hanging.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace voxmelt {
namespace {

using namespace hanging;

scene::Scene load(const std::string& name) {
  return scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (name + ".toml"), {});
}

TEST(Hanging, NothingInTheShowcases) {
  int seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(VOXMELT_SCENES_FOLDER)) {
    if (entry.path().extension() != ".toml") continue;
    const scene::Scene scene = load(entry.path().stem().string());
    if (scene.parameters.pieces.fall) seen += watch(scene, scene.parameters, static_cast<int>(scene.steps));
  }
  EXPECT_GE(seen, 20) << "hardly anything fell";
}

// A source somewhere else, as hands would move it, and up to four times as strong.
TEST(Hanging, NothingWhereverTheSourceIs) {
  int seen = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    const scene::Scene scene = load(random.any({"cello", "bunny", "cello_viscous", "bunny_viscous"}));
    Parameters parameters = scene.parameters;
    const Grid g = scene.initial.grid;
    rule::SourceKey key = parameters.heat.sources.at(0).keys.at(0);
    key.step = 0;
    key.at = {random.between(-64, 16 * g.x + 64), random.between(32, 16 * g.y + 320),
              random.between(-64, 16 * g.z + 64)};
    key.power *= static_cast<std::uint64_t>(random.between(1, 4));
    parameters.heat.sources.at(0).keys = {key};
    SCOPED_TRACE("seed " + std::to_string(seed));
    seen += watch(scene, parameters, 700);
  }
  EXPECT_GE(seen, 20) << "hardly anything fell";
}

}  // namespace
}  // namespace voxmelt
