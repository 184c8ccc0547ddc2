// The settings of a scene that a checkpoint keeps give the same scene again, except for the cells of its
// grid.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

#include "kernel/run/io/export.h"
#include "kernel/scene/text/print.h"
#include "tests/kernel/scene/scene_text.h"

namespace voxmelt::scene {
namespace {

namespace fs = std::filesystem;

TEST(Settings, OfEveryScene) {
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(VOXMELT_SCENES_FOLDER)) {
    if (entry.path().extension() != ".toml") continue;
    ++scenes;
    SCOPED_TRACE(entry.path().filename().string());
    const Scene scene = load(entry.path(), {"run.steps=17"});
    Scene again = load_settings(scene.settings, "again");
    EXPECT_EQ(again.settings, scene.settings);
    fill(again, scene.initial);  // walls are known by the cells
    EXPECT_EQ(io::parameters_json(again.parameters, again.initial.grid, 0),
              io::parameters_json(scene.parameters, scene.initial.grid, 0));
    EXPECT_EQ(again.steps, 17u);
    EXPECT_EQ(again.frame_every, scene.frame_every);
    EXPECT_EQ(again.features, scene.features);
    EXPECT_EQ(again.look, scene.look);
    EXPECT_EQ(again.light, scene.light);
    EXPECT_EQ(again.camera.target, scene.camera.target);
    EXPECT_EQ(again.camera.azimuth, scene.camera.azimuth);
    EXPECT_EQ(again.camera.elevation, scene.camera.elevation);
    EXPECT_EQ(again.camera.distance, scene.camera.distance);
    EXPECT_EQ(again.camera.field_of_view, scene.camera.field_of_view);
    EXPECT_EQ(again.camera.width, scene.camera.width);
    EXPECT_EQ(again.camera.height, scene.camera.height);
  }
  EXPECT_GT(scenes, 20);
}

TEST(Settings, EveryKindOfValueIsPrinted) {
  const auto origin = std::make_shared<const Origin>(Origin{"here", {}, false});
  const std::string text =
      "a = 1\nb = -0.1\nc = 1e300\nd = true\ne = \"q\\\"\\\\ \\u0001\\n\"\n"
      "f = [1.0, 5e-324, [2]]\ng = {h = \"x\", \"i j\" = {}}\nk = inf\n";
  const std::string printed = print_document(parse_text(text, origin));
  EXPECT_EQ(print_document(parse_text(printed, origin)), printed);
  EXPECT_EQ(printed,
            "a = 1\nb = -0.1\nc = 1e+300\nd = true\ne = \"q\\\"\\\\ \\u0001\\u000a\"\n"
            "f = [1.0, 5e-324, [2]]\nk = inf\n\n[g]\nh = \"x\"\n\n[g.\"i j\"]\n");
}

}  // namespace
}  // namespace voxmelt::scene
