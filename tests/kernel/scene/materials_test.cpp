// [[materials]] become a palette, and shapes take their materials from it.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/kernel/scene/scene_text.h"

namespace voxmelt::scene {
namespace {

const std::string kBody = R"([grid]
size = [8, 8, 8]
[material]
melting_point = 0.5
[heat]
neighbours = 18
gamma = 0.2
[heat.air]
exchange = 0.1
bottom = 0.9
[[materials]]
name = "stone"
melting_point = 0.25
latent_heat = 0.125
conductivity = 0.5
capacity = 2
color = [0.1, 0.2, 0.3]
[[materials]]
name = "nut"
conductivity = 0
[[solid]]
shape = "box"
at = [4, 4, 4]
size = [8, 8, 8]
temperature = 0.125
)";

// weight_face is floor(65536 gamma / pi), with gamma 0.2 by the harmonic mean of the conductivities: 1 and
// 1/2 have 2/3. The weights of edges have half of gamma.
TEST(Materials, WeightsAreHarmonicMeans) {
  const SceneFolder folder;
  const Scene scene = folder.load_text(kBody);
  ASSERT_EQ(scene.parameters.materials.size(), 3u);
  const rule::SolidMaterial &first = scene.parameters.materials[0], &stone = scene.parameters.materials[1],
                            &nut = scene.parameters.materials[2];
  EXPECT_EQ(first.weight_face[0], 4172);
  EXPECT_EQ(first.weight_face[0], scene.parameters.heat.weight_face);
  EXPECT_EQ(first.weight_edge[0], scene.parameters.heat.weight_edge);
  EXPECT_EQ(first.weight_face[1], 2781) << "4172.15 x 2/3 is 2781.4";
  EXPECT_EQ(stone.weight_face[0], 2781);
  EXPECT_EQ(stone.weight_face[1], 2086);
  EXPECT_EQ(stone.weight_edge[1], 1043);
  EXPECT_EQ(stone.weight_corner[1], 0) << "18 neighbours";
  EXPECT_EQ(nut.weight_face[0], 0);
  EXPECT_EQ(nut.weight_face[2], 0);
}

// Air and half a cell lie one behind the other: 0.1 / (1 + 0.1 / half), half = 2 (face + 4 edge) / 65536.
// That is 0.38196 for the first, 0.19098 for stone; nothing conducts in a nut, so it has one temperature.
TEST(Materials, AirMeetsEachByItsConductivity) {
  const SceneFolder folder;
  const Scene scene = folder.load_text(kBody);
  EXPECT_EQ(scene.parameters.materials[0].air_exchange, 5194);
  EXPECT_EQ(scene.parameters.materials[0].air_exchange, scene.parameters.heat.air_exchange);
  EXPECT_EQ(scene.parameters.materials[1].air_exchange, 4301);
  EXPECT_EQ(scene.parameters.materials[2].air_exchange, 6554);
}

TEST(Materials, PointsAndCapacity) {
  const SceneFolder folder;
  const Scene scene = folder.load_text(kBody);
  const rule::SolidMaterial &stone = scene.parameters.materials[1], &nut = scene.parameters.materials[2];
  EXPECT_EQ(stone.melting_point, 16384);
  EXPECT_EQ(stone.latent_heat, 8192);
  EXPECT_EQ(stone.warmth, 32768u);
  EXPECT_EQ(nut.melting_point, 32768);
  EXPECT_EQ(nut.warmth, 65536u);
  EXPECT_EQ(scene.materials, (std::vector<std::string>{"", "stone", "nut"}));
  ASSERT_EQ(scene.look.materials.size(), 3u);
  EXPECT_EQ(scene.look.materials[0], scene.look.solid);
  EXPECT_EQ(scene.look.materials[1], (Vec3{0.1, 0.2, 0.3}));
  EXPECT_EQ(scene.look.materials[2], scene.look.solid);
}

// The second box covers four layers whole, and half of a fifth. The third covers less than half of a cell.
TEST(Materials, ACellIsOfTheLastShapeThatCoversHalfOfIt) {
  const SceneFolder folder;
  const Scene scene = folder.load_text(kBody +
                                       "[[solid]]\nshape = \"box\"\nat = [4, 2.25, 4]\nsize = [8, 4.5, 8]\n"
                                       "material = \"stone\"\n[[solid]]\nshape = \"box\"\n"
                                       "at = [4, 5.125, 4]\nsize = [8, 0.25, 8]\nmaterial = \"nut\"\n");
  const state::Volume& v = scene.initial;
  const auto material = [&](int y) { return int{v.material[v.at(3, y, 3)]}; };
  const auto heat = [&](int y) { return int{v.heat[v.at(3, y, 3)]}; };
  EXPECT_EQ(material(0), 1);
  EXPECT_EQ(material(3), 1);
  EXPECT_EQ(material(4), 1) << "half of it";
  EXPECT_EQ(material(5), 0) << "a quarter of it";
  EXPECT_EQ(material(7), 0);
  EXPECT_EQ(heat(7), 8192);
  EXPECT_EQ(heat(0), 16384) << "twice the heat at the same temperature";
}

TEST(Materials, WhatIsWrongIsSaid) {
  const SceneFolder folder;
  const auto error = [&](const std::string& table) {
    return folder.error_of("[grid]\nsize = [8, 8, 8]\n" + table);
  };
  EXPECT_EQ(error("[[materials]]\nmelting_point = 1\n"),
            "scene.toml:3:1: error: materials.0.name is missing");
  EXPECT_EQ(error("[[materials]]\nname = \"a b\"\n"),
            "scene.toml:4:8: error: materials.0.name = \"a b\" is not one word of letters, digits, - and _");
  EXPECT_EQ(error("[[materials]]\nname = \"a\"\n[[materials]]\nname = \"a\"\n"),
            "scene.toml:6:8: error: materials.1.name = \"a\" is the name of another one");
  EXPECT_EQ(
      error("[[materials]]\nname = \"a\"\ncapacity = 2\nmelting_point = 0.51\n"),
      "scene.toml:6:17: error: materials.0.melting_point = 0.51 needs capacity x melting_point + latent_heat "
      "= 1.02 of heat, and 1 is the most: it could never melt");
  EXPECT_EQ(
      error("[material]\nfreezing_point = 0.4\n[[materials]]\nname = \"a\"\nmelting_point = 0.3\n"),
      "scene.toml:7:17: error: materials.0.melting_point = 0.3 is below material.freezing_point: what melts "
      "would freeze");
  EXPECT_EQ(error("[heat]\ngamma = 0.5\n[[materials]]\nname = \"a\"\nconductivity = 1.1\n"),
            "scene.toml:7:16: error: materials.0.conductivity = 1.1 exceeds 1.0472, the bound of gamma x "
            "conductivity");
  EXPECT_EQ(error("[[solid]]\nshape = \"sphere\"\nradius = 2\nat = [4, 4, 4]\nmaterial = \"a\"\n"),
            "scene.toml:7:12: error: solid.0.material needs [[materials]]: the scene has one material");
  EXPECT_EQ(error("[[materials]]\nname = \"nut\"\n[[solid]]\nshape = \"sphere\"\nradius = 2\nat = [4, 4, "
                  "4]\nmaterial = \"nuts\"\n"),
            "scene.toml:9:12: error: solid.0.material = \"nuts\" is not one of nut");
  std::string many = "[grid]\nsize = [8, 8, 8]\n";
  for (int i = 0; i < 16; ++i) many += "[[materials]]\nname = \"m" + std::to_string(i) + "\"\n";
  EXPECT_EQ(folder.error_of(many), "scene.toml:33:1: error: at most 15 further materials");
}

}  // namespace
}  // namespace voxmelt::scene
