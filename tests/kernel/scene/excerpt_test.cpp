// A part of a scene becomes a file of its own. It says the same as the scene.
#include "kernel/scene/excerpt.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "kernel/run/io/export.h"
#include "tests/kernel/scene/scene_text.h"

namespace voxmelt::scene {
namespace {

// Loads the excerpt from another folder than its scene's.
Scene loaded(const SceneFolder& folder, const std::filesystem::path& file,
             const std::vector<std::string>& sets, const Part& part, std::uint32_t step) {
  const std::filesystem::path place = folder.path() / "excerpt";
  std::filesystem::create_directories(place / "state");
  io::export_npy(state::Volume({part.size[0], part.size[1], part.size[2]}), place / "state");
  std::ofstream(place / "scene.toml") << Excerpt(file, sets).text(part, "state", step);
  return load(place / "scene.toml", {});
}

std::string parameters_of(const Scene& scene) {
  return io::parameters_json(scene.parameters, scene.initial.grid, 0);
}

TEST(Excerpt, OfAWholeSceneHasAllItsParameters) {
  const SceneFolder folder;
  int scenes = 0;
  for (const char* name : {"cello", "lava_viscous", "proving_ground", "proving_ground_ends_viscous",
                           "lesson_sky", "lesson_soft_shadow", "ice", "sandbox"}) {
    const std::filesystem::path file = committed_scenes() / (std::string(name) + ".toml");
    if (!std::filesystem::exists(file)) continue;
    ++scenes;
    const std::vector<std::string> sets{"run.seed=77", "flow.fall.factor=0.7"};
    Scene whole = load(file, sets);
    const state::Grid g = whole.initial.grid;
    whole.parameters.heat.walls = false;  // the fields are empty
    const Scene again = loaded(folder, file, sets, {{}, {g.x, g.y, g.z}, {}}, 0);
    EXPECT_EQ(parameters_of(again), parameters_of(whole)) << name;
  }
  EXPECT_GE(scenes, 6);
}

TEST(Excerpt, MovesWhatHasAPlace) {
  const SceneFolder folder;
  const std::filesystem::path file = folder.write("whole.toml", R"(
[grid]
size = [30, 20, 22]
border = "open"
[heat]
[heat.air]
exchange = 0.01
bottom = 0.2
[[heat_source]]
power = 7
at = [30, 22.5, 25]
[[heat_source]]
keyframes = [{step = 3, at = [10, 11, 12], power = 1}, {step = 9, at = [20, 21, 22], power = 2}]
[[heat_source]]
kind = "sky"
power = 0.5
[[vent]]
at = [20, 17, 6]
radius = 2.5
rate = 0.1
[[drain]]
at = [13.25, 2, 17]
radius = 4
rate = 0.06
)");
  const Scene part = loaded(folder, file, {}, {{8, 2, 4}, {6, 7, 8}, {}}, 5);
  EXPECT_EQ(part.initial.grid, (state::Grid{6, 7, 8}));
  EXPECT_EQ(part.first_step, 5u);
  const auto is = [](const rule::Position& at, double x, double y, double z) {
    return static_cast<double>(at.x) == 16 * x && static_cast<double>(at.y) == 16 * y &&
           static_cast<double>(at.z) == 16 * z;
  };
  ASSERT_EQ(part.parameters.heat.sources.size(), 3u);
  EXPECT_TRUE(is(part.parameters.heat.sources[0].keys[0].at, 22, 20.5, 21));
  ASSERT_EQ(part.parameters.heat.sources[1].keys.size(), 2u);
  EXPECT_TRUE(is(part.parameters.heat.sources[1].keys[1].at, 12, 19, 18));
  EXPECT_TRUE(is(part.parameters.vents.at(0).region.at, 12, 15, 2));
  EXPECT_TRUE(is(part.parameters.drains.at(0).region.at, 5.25, 0, 13));

  const Excerpt excerpt(file, {});
  EXPECT_EQ(excerpt.removable(),
            (std::vector<std::string>{"vent.0", "drain.0", "heat_source.0", "heat_source.1", "heat_source.2",
                                      "grid.border", "heat.air"}));
  const Scene less =
      loaded(folder, file, {}, {{}, {6, 7, 8}, {"vent.0", "heat_source.1", "grid.border", "heat.air"}}, 5);
  EXPECT_TRUE(part.parameters.open_border);
  EXPECT_FALSE(less.parameters.open_border);
  EXPECT_TRUE(less.parameters.vents.empty());
  EXPECT_EQ(less.parameters.drains.size(), 1u);
  ASSERT_EQ(less.parameters.heat.sources.size(), 2u);
  EXPECT_EQ(less.parameters.heat.sources[1].kind, rule::SourceKind::sky);
  EXPECT_FALSE(less.parameters.heat.air);
}

// The camera stands at its place, and the look and the floor are the scene's. Its sources of heat and liquid
// are gone.
TEST(Excerpt, OfAPictureMovesItsCamera) {
  const SceneFolder folder;
  const std::filesystem::path file = folder.write("whole.toml", R"(
[grid]
size = [30, 20, 22]
[heat]
[[heat_source]]
power = 7
at = [30, 22.5, 25]
[[vent]]
at = [20, 17, 6]
radius = 2.5
rate = 0.1
[[inert]]
shape = "floor"
thickness = 2
[[inert]]
shape = "sphere"
at = [5, 5, 5]
radius = 2
[[solid]]
shape = "sphere"
at = [15, 10, 11]
radius = 3
[light]
ambient = 0.25
[look]
solid = [0.1, 0.2, 0.3]
)");
  Camera camera{{12.5, 7, 8.25}, 40, 20, 33.5, 25, true, 64, 48};
  const std::filesystem::path place = folder.path() / "excerpt";
  std::filesystem::create_directories(place / "state");
  io::export_npy(state::Volume({6, 7, 8}), place / "state");
  std::ofstream(place / "scene.toml")
      << Excerpt(file, {"look.glow=true"}).picture_text({{8, 2, 4}, {6, 7, 8}, {}}, "state", camera);
  const Scene part = load(place / "scene.toml", {});
  EXPECT_EQ(part.camera.target, (Vec3{4.5, 5, 4.25}));
  EXPECT_EQ(part.camera.distance, 33.5);
  EXPECT_EQ(part.camera.field_of_view, 25);
  EXPECT_EQ(part.camera.azimuth, 40);
  EXPECT_EQ(part.camera.elevation, 20);
  EXPECT_TRUE(part.camera.orthographic);
  EXPECT_EQ(part.camera.width, 64);
  EXPECT_EQ(part.camera.height, 48);
  EXPECT_EQ(part.light.ambient, 0.25);
  EXPECT_EQ(part.look.solid, (Vec3{0.1, 0.2, 0.3}));
  EXPECT_TRUE(part.look.glow);
  EXPECT_EQ(part.terrain.height, std::vector<float>(48, 2.0F));
  EXPECT_TRUE(part.parameters.vents.empty() && part.parameters.heat.sources.empty());
}

// Wherever the excerpt lies, it finds the heights that the scene named.
TEST(Excerpt, OfAPictureKeepsItsTerrain) {
  const SceneFolder folder;
  const std::filesystem::path file = committed_scenes() / "lava.toml";
  const Scene whole = load(file, {});
  const state::Grid g = whole.initial.grid;
  const std::filesystem::path place = folder.path() / "excerpt";
  std::filesystem::create_directories(place / "state");
  io::export_npy(whole.initial, place / "state");
  std::ofstream(place / "scene.toml")
      << Excerpt(file, {}).picture_text({{}, {g.x, g.y, g.z}, {}}, "state", whole.camera);
  const Scene again = load(place / "scene.toml", {});
  EXPECT_EQ(again.terrain, whole.terrain);
  std::ofstream(place / "bare.toml") << Excerpt(file, {}).picture_text({{}, {g.x, g.y, g.z}, {"terrain"}},
                                                                       "state", whole.camera);
  EXPECT_EQ(load(place / "bare.toml", {}).terrain.height, std::vector<float>(whole.terrain.height.size()));
  EXPECT_EQ(again.initial, whole.initial);
  EXPECT_EQ(again.look, whole.look);
  EXPECT_EQ(again.light, whole.light);
}

}  // namespace
}  // namespace voxmelt::scene
