// The scene loader knows defaults, units, --set and extends.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "kernel/scene/features.h"
#include "tests/kernel/scene/scene_text.h"

namespace voxmelt::scene {
namespace {

const std::string kLeast =
    "[grid]\nsize = [8, 9, 10]\n[[solid]]\nshape = \"box\"\nsize = [2, 2, 2]\nat = [4, 4, 4]\n";

TEST(Load, DefaultsOfTheLeastScene) {
  const SceneFolder folder;
  const Scene scene = folder.load_text(kLeast);
  EXPECT_EQ(scene.name, "scene");
  EXPECT_EQ(scene.title, "scene");
  EXPECT_EQ(scene.file, folder.path() / "scene.toml");
  EXPECT_EQ(scene.steps, 1000u);
  EXPECT_EQ(scene.initial.grid, (state::Grid{8, 9, 10}));
  EXPECT_EQ(scene.initial.solid.count(), 8);
  EXPECT_EQ(scene.parameters.seed, 1u);
  EXPECT_EQ(scene.parameters.flow.law, rule::Law::paper);
  EXPECT_EQ(scene.parameters.flow.paper.share, 8192);
  EXPECT_EQ(scene.parameters.flow.fall.factor, 65536u);
  EXPECT_EQ(scene.parameters.material.melting_point, 32768);
  EXPECT_FALSE(scene.parameters.heat.enabled);
  EXPECT_EQ(scene.features, std::vector<std::string>{"diagonal"});
  EXPECT_EQ(scene.camera.target, (Vec3{4, 4.5, 5}));
  EXPECT_EQ(scene.camera.distance, 0);  // the renderer fits the grid
  EXPECT_FALSE(scene.camera.orthographic);
  EXPECT_EQ(scene.terrain.height.size(), 80u);
  EXPECT_FALSE(scene.terrain.textured);
}

TEST(Load, WhatASceneDoesNotModelIsNotThere) {
  const SceneFolder folder;
  const std::string warm =
      kLeast + "temperature = 0.4\n[[liquid]]\nshape = \"box\"\nsize = [1, 1, 1]\nat = [1, 1, 1]\n";
  const auto holds = [&](const std::string& more) {
    const state::Volume volume = folder.load_text(warm + more).initial;
    const auto any = [](const auto& field) {
      return std::any_of(field.stored().begin(), field.stored().end(), [](int value) { return value != 0; });
    };
    return std::pair(any(volume.energy), any(volume.heat));
  };
  const std::string heat = "[heat]\ngamma = 0.1\n",
                    viscous = "[flow]\nlaw = \"viscous\"\nviscous = {kappa = 0.1}\n";
  EXPECT_EQ(holds(heat), std::pair(true, true));
  EXPECT_EQ(holds(""), std::pair(true, false)) << "no heat without [heat]";
  EXPECT_EQ(holds(heat + viscous), std::pair(false, true)) << "no energy under the viscous law";
}

// Numbers that are 1 together are rounded apart. 0.5 and 0.3 of 65535 lie on halves, or a decimal is off.
TEST(Load, TheWholeRangeMayBeUsed) {
  const SceneFolder folder;
  const std::pair<const char*, const char*> pairs[] = {
      {"0.5", "0.5"}, {"0.1", "0.9"}, {"0.3", "0.7"}, {"0.7", "0.3"}};
  for (const auto& [point, latent] : pairs) {
    const std::string material =
        std::string("[material]\nmelting_point = ") + point + "\nlatent_heat = " + latent;
    const rule::Material made = folder.load_text(kLeast + material + "\n").parameters.material;
    EXPECT_EQ(made.melting_point + made.latent_heat, 65535) << point;
  }
  const std::string warm =
      kLeast + "[heat]\ngamma = 0.1\n[material]\nmelting_point = 0.5\nlatent_heat = 0.3\n";
  const Scene wall = folder.load_text(warm + "[[inert]]\nshape = \"floor\"\ntemperature = 0.7\n");
  EXPECT_EQ(wall.initial.heat[wall.initial.at(0, 0, 0)], 65535);
  const Scene sun = folder.load_text(
      warm + "[[heat_source]]\nkind = \"directional\"\ndirection = [0, 2e-9, 1e-9]\npower = 1\n");
  EXPECT_EQ(sun.parameters.heat.sources.at(0).keys.at(0).direction.y, 32768);
  EXPECT_EQ(sun.parameters.heat.sources.at(0).keys.at(0).direction.z, 16384);
}

// The viscous law has 5 octaves from 0.5 to 1, so its mobility is 32 times that at the reference. A rate is
// 64 x 65536 / 65535 / 0.1. At kappa 71 the reference stays, and eight octaves above it are enough. With
// doubling 0.05 they are not. The paper's law wants 2^4.84375 = 28.7 at its hottest entry, temperature 63/64.
TEST(Load, HotLiquidIsAsMobileAsItsLawSays) {
  const SceneFolder folder;
  const auto flow = [&](double kappa, const char* law = "viscous", const char* doubling = "0.1") {
    return folder.load_text(kLeast + "[flow]\nlaw = \"" + law +
                            "\"\n[flow.thermal]\nreference = 0.5\ndoubling = " + doubling + "\n" +
                            (law == std::string("viscous")
                                 ? "[flow.viscous]\nkappa = " + std::to_string(kappa) + "\n"
                                 : "[flow.paper]\nshare = " + std::to_string(kappa) + "\n"));
  };
  const Scene free = flow(1);
  EXPECT_TRUE(free.warnings.empty());
  EXPECT_EQ(free.parameters.flow.viscous.mobility, std::uint64_t{32} * 954437177);  // 2^32 x 2/9, rounded
  EXPECT_EQ(free.parameters.flow.mobility_reference, 65535);
  EXPECT_EQ(free.parameters.flow.mobility_rate, 640);
  const Scene runny = flow(71);
  EXPECT_TRUE(runny.warnings.empty());
  EXPECT_NEAR(runny.parameters.flow.mobility_reference, 65535 * 0.502018, 1);  // 2^36 / (2^32 x 2/9 x 71)
  const Scene cut = flow(71, "viscous", "0.05");
  ASSERT_EQ(cut.warnings.size(), 1u);
  EXPECT_EQ(cut.warnings[0],
            "flow.thermal: the mobility wants to be 1.02e+03 times that at the reference, and stops at 260 "
            "times, from temperature 0.901 on");
  // A share of 1/32 may grow to 1/8 before it would exceed 1/5. The rule allows four times as much.
  const Scene paper = flow(1 / 32.0, "paper");
  EXPECT_TRUE(paper.warnings.empty());
  EXPECT_EQ(paper.parameters.flow.paper.share, 8192);
  EXPECT_EQ(paper.parameters.flow.mobility_table[16], 9129);  // 32768 x 1.114387 / 4
}

TEST(Load, AnExchangeThatIsRoundedIsWarnedOf) {
  const SceneFolder folder;
  const auto scene = [&](const char* exchange) {
    return folder.load_text(kLeast + "[heat.air]\nexchange = " + exchange + "\nbottom = 1\n");
  };
  EXPECT_EQ(scene("2e-5").warnings,  // 1.31 of 65536
            std::vector<std::string>{
                "heat.air.exchange = 2e-05 is taken as 1.53e-05, in whole numbers of 1/65536"});
  EXPECT_TRUE(scene("0.001").warnings.empty());  // 65.5
}

// Half a cell conducts 2 gamma / pi, which is 6258 / 65536 at gamma 0.15. Behind it an exchange of 0.1 is
// 0.1 / (1 + 0.1 / 0.0954895) = 0.0488463. Without conduction it is 0.1.
TEST(Load, AirMeetsTheSurfaceOfACell) {
  const SceneFolder folder;
  const auto exchange = [&](const char* gamma) {
    return folder
        .load_text(kLeast + "[heat]\ngamma = " + gamma + "\n[heat.air]\nexchange = 0.1\nbottom = 1\n")
        .parameters.heat.air_exchange;
  };
  EXPECT_EQ(exchange("0.15"), 3201);
  EXPECT_EQ(exchange("0"), 6554);
}

// A checkerboard's difference is multiplied by 1 - 12 gamma / pi, which is -0.910 at gamma 0.5 and -0.5 at pi
// / 8.
TEST(Load, AGammaThatLetsHeatSwingIsWarnedOf) {
  const SceneFolder folder;
  const auto scene = [&](const char* gamma, const char* neighbours) {
    return folder.load_text(kLeast + "[heat]\ngamma = " + gamma + "\nneighbours = " + neighbours + "\n");
  };
  EXPECT_EQ(scene("0.5", "6").warnings,
            std::vector<std::string>{"heat.gamma = 0.5 is above 0.3927: hot and cold cells that alternate "
                                     "change places in each step and keep 91 % of their difference"});
  EXPECT_EQ(scene("0.3928", "18").warnings.size(), 1u);
  for (const auto& [gamma, neighbours] : {std::pair("0.3926", "6"), {"0.3926", "18"}, {"0.5236", "26"}})
    EXPECT_TRUE(scene(gamma, neighbours).warnings.empty()) << gamma;
  const rule::Heat off = scene("0", "26").parameters.heat;
  EXPECT_EQ(off.weight_face + off.weight_edge + off.weight_corner, 0);
  EXPECT_TRUE(scene("0", "26").warnings.empty());
}

// The defaults are written twice: in the declaration of the parameters, and in the reading of a table.
TEST(Load, AnEmptyTableIsAsGoodAsNone) {
  const SceneFolder folder;
  const rule::Flow without = folder.load_text(kLeast).parameters.flow;
  const rule::Flow with = folder.load_text(kLeast + "[flow.fall]\n[flow.paper]\n").parameters.flow;
  EXPECT_EQ(with.fall.factor, without.fall.factor);
  EXPECT_EQ(with.fall.wall_factor, without.fall.wall_factor);
  EXPECT_EQ(with.fall.minimum, without.fall.minimum);
  EXPECT_EQ(with.fall.hang, without.fall.hang);
  const rule::PaperLaw &a = with.paper, &b = without.paper;
  EXPECT_EQ(a.neighbours, b.neighbours);
  EXPECT_EQ(a.threshold, b.threshold);
  EXPECT_EQ(a.use_table, b.use_table);
  EXPECT_EQ(a.share, b.share);
  EXPECT_EQ(a.downhill, b.downhill);
  EXPECT_EQ(a.margin, b.margin);
  EXPECT_EQ(a.support, b.support);
  EXPECT_EQ(a.slump, b.slump);
  EXPECT_EQ(a.reading, b.reading);
  EXPECT_EQ(a.beta, b.beta);
  EXPECT_EQ(a.alpha_liquid, b.alpha_liquid);
  EXPECT_EQ(a.alpha_solid, b.alpha_solid);
  EXPECT_EQ(a.alpha_floor, b.alpha_floor);
  EXPECT_EQ(a.reheat, b.reheat);
}

TEST(Load, UnitsOfTheAutomaton) {
  const SceneFolder folder;
  const rule::Parameters p = folder
                                 .load_text(kLeast + R"(
[run]
seed = 77
[material]
melting_point = 0.75
latent_heat = 0.25
freezing_point = 0.5
[heat]
neighbours = 26
gamma = 0.5236
convection = 0.5
[heat.air]
exchange = 0.57735
bottom = 0.0
top = 1.0
glow = 0.16666
sky = 0.25
[[heat_source]]
at = [-1.5, 10, 20.0625]
power = 140
[[heat_source]]
kind = "point"
keyframes = [{ step = 0, at = [0, 0, 0], power = 0 }, { step = 9, at = [1, 0, 0], power = 4194303 }]
[[heat_source]]
kind = "sphere"
at = [1, 2, 3]
radius = 2.5
power = 2
[[heat_source]]
kind = "directional"
keyframes = [{ step = 3, direction = [0.3, -0.4, 0.1], power = 1 }, { step = 8, direction = [0, 7, 0], power = 2 }]
[[heat_source]]
kind = "sky"
power = 0.5
[[vent]]
at = [4, 4, 4]
radius = 2.5
rate = 0.5
temperature = 0.5
until = 10
[[drain]]
at = [0, 0, 0]
radius = 1
rate = 1
from = 5
[flow.fall]
factor = 0.5
hang = 0.25
[flow.paper]
share = 0.2
threshold = 0.45
alpha_liquid = 1
beta = 4
reheat = 0.5
[flow.thermal]
reference = 0.015625
doubling = 0.03125
)")
                                 .parameters;
  EXPECT_EQ(p.seed, 77u);
  EXPECT_EQ(p.material.melting_point, 49151);
  EXPECT_EQ(p.material.latent_heat, 16384);
  EXPECT_EQ(p.material.freezing_point, 32768);
  EXPECT_EQ(p.heat.air_glow, 10922);
  EXPECT_EQ(p.heat.air_sky, 16384);
  EXPECT_EQ(p.heat.weight_face, 10922);
  EXPECT_EQ(p.heat.weight_edge, 5461);
  EXPECT_EQ(p.heat.weight_corner, 3640);
  EXPECT_EQ(p.heat.convection, 32767);
  EXPECT_EQ(p.heat.air_exchange, 27031);  // 0.57735, behind 2 x 47326 / 65536
  ASSERT_EQ(p.heat.air_temperature.size(), 9u);
  EXPECT_EQ(p.heat.air_temperature.front(), 0);
  EXPECT_EQ(p.heat.air_temperature[4], 32768);
  EXPECT_EQ(p.heat.air_temperature.back(), 65535);
  ASSERT_EQ(p.heat.sources.size(), 5u);
  using enum rule::SourceKind;
  EXPECT_EQ(p.heat.sources[1].kind, point);
  EXPECT_EQ(p.heat.sources[2].kind, sphere);
  EXPECT_EQ(p.heat.sources[2].keys[0].at.y, 32);
  EXPECT_EQ(p.heat.sources[2].keys[0].radius, 40);
  EXPECT_EQ(p.heat.sources[3].kind, directional);
  EXPECT_EQ(p.heat.sources[3].keys[0].step, 3u);
  const rule::Position sun = p.heat.sources[3].keys[0].direction;  // -0.4 becomes -32768
  EXPECT_EQ(sun.x, 24576);
  EXPECT_EQ(sun.y, -32768);
  EXPECT_EQ(sun.z, 8192);
  EXPECT_EQ(p.heat.sources[3].keys[1].direction.y, 32768);
  EXPECT_EQ(p.heat.sources[3].keys[1].power, std::uint64_t{2} << 28);
  EXPECT_EQ(p.heat.sources[4].kind, sky);
  EXPECT_EQ(p.heat.sources[4].keys[0].power, std::uint64_t{1} << 27);
  EXPECT_EQ(p.heat.sources[0].keys[0].at.x, -24);
  EXPECT_EQ(p.heat.sources[0].keys[0].at.z, 321);
  EXPECT_EQ(p.heat.sources[0].keys[0].power, std::uint64_t{140} << 28);
  EXPECT_LT(p.heat.sources[1].keys[1].power, std::uint64_t{1} << 50);
  EXPECT_EQ(p.vents[0].region.radius, 40);
  EXPECT_EQ(p.vents[0].rate, 2048);
  EXPECT_EQ(p.vents[0].energy, 4096);
  EXPECT_EQ(p.vents[0].until, 10u);
  EXPECT_EQ(p.drains[0].from, 5u);
  EXPECT_EQ(p.drains[0].until, 0xFFFFFFFFu);
  EXPECT_EQ(p.flow.fall.factor, 32768u);
  EXPECT_EQ(p.flow.fall.wall_factor, 32768u);
  EXPECT_EQ(p.flow.fall.hang, 1024);
  EXPECT_EQ(p.flow.paper.share, 13107);
  EXPECT_EQ(p.flow.paper.threshold, 1843);
  EXPECT_EQ(p.flow.paper.alpha_liquid, 65535);
  EXPECT_EQ(p.flow.paper.beta, 262144u);
  EXPECT_EQ(p.flow.mobility_table[0], 32768);
  EXPECT_EQ(p.flow.mobility_table[1], 65535);
  EXPECT_EQ(features_of(p), (std::vector<std::string>{"heat", "radiation", "air", "convection", "latent_heat",
                                                      "freezing", "glow", "vent", "drain", "diagonal", "drip",
                                                      "reheat", "thermal_viscosity"}));
}

// Glow needs no moving air.
TEST(Load, GlowAlone) {
  const SceneFolder folder;
  const std::string heat = std::string(kLeast) + "[heat]\n[heat.air]\n";
  const rule::Parameters p = folder.load_text(heat + "glow = 0.01\n").parameters;
  EXPECT_EQ(p.heat.air_glow, 655);
  EXPECT_EQ(p.heat.air_sky, 0);
  EXPECT_EQ(p.heat.air_exchange, 0);
  EXPECT_EQ(p.heat.air_temperature, std::vector<rule::Temperature>(9, 0));
  EXPECT_EQ(p.material.freezing_point, 0) << "nothing freezes unless a scene says so";
  const rule::Parameters still = folder.load_text(heat + "exchange = 0.01\nbottom = 0\n").parameters;
  EXPECT_EQ(still.heat.air_glow, 0);
}

TEST(Load, TheCamerasProjection) {
  const SceneFolder folder;
  const auto parallel = [&](const char* name) {
    return folder.load_text(std::string(kLeast) + "[camera]\nprojection = \"" + name + "\"\n")
        .camera.orthographic;
  };
  EXPECT_TRUE(parallel("orthographic"));
  EXPECT_FALSE(parallel("perspective"));
}

TEST(Load, TheBorder) {
  const SceneFolder folder;
  const auto loaded = [&](const std::string& key) {
    return folder.load_text("[grid]\nsize = [8, 8, 8]\n" + key +
                            "[[vent]]\nat = [4, 4, 4]\nradius = 1\nrate = 1\n");
  };
  EXPECT_FALSE(loaded("").parameters.open_border);
  EXPECT_FALSE(loaded("border = 'closed'\n").parameters.open_border);
  const Scene open = loaded("border = 'open'\n");
  EXPECT_TRUE(open.parameters.open_border);
  EXPECT_EQ(open.features, (std::vector<std::string>{"vent", "open_border", "diagonal"}));
  EXPECT_TRUE(load_settings(open.settings, "a checkpoint").parameters.open_border);
}

TEST(Load, PiecesFallIfTheSceneNamesThem) {
  const SceneFolder folder;
  const auto pieces = [&](const std::string& table) {
    return folder.load_text(kLeast + table).parameters.pieces;
  };
  EXPECT_FALSE(pieces("").fall);
  EXPECT_FALSE(pieces("[pieces]\nfall = false\n").fall);
  const rule::Pieces usual = pieces("[pieces]\n");
  EXPECT_TRUE(usual.fall);
  EXPECT_EQ(usual.in_liquid, 1);
  EXPECT_EQ(usual.density, 65536);
  const rule::Pieces ice = pieces("[pieces]\nin_liquid = 7\ndensity = 0.75\n");
  EXPECT_EQ(ice.in_liquid, 7);
  EXPECT_EQ(ice.density, 49152);
}

TEST(Load, SubstepsOfTheViscousLaw) {
  const SceneFolder folder;
  const auto law = [&](const std::string& keys) {
    return folder.load_text(kLeast + "[flow]\nlaw='viscous'\n[flow.viscous]\nkappa=1\n" + keys)
        .parameters.flow.viscous;
  };
  EXPECT_EQ(law("substeps=7\n").substeps, 7);
  EXPECT_EQ(law("substeps='auto'\n").substeps, 0);
  EXPECT_EQ(law("").substeps, 0);
  EXPECT_EQ(law("substeps='auto'\nsubsteps_max=16\n").substeps_max, 16);
  EXPECT_EQ(law("").stages_max, 1);
  EXPECT_EQ(law("stages_max=16\n").stages_max, 16);
}

TEST(Load, MobilityOfTheViscousLaw) {
  const SceneFolder folder;
  const rule::Flow flow =
      folder.load_text(kLeast + "[flow]\nlaw='viscous'\n[flow.viscous]\nkappa=0.02\nyield=1\nstiffness=1\n")
          .parameters.flow;
  EXPECT_EQ(flow.law, rule::Law::viscous);
  EXPECT_EQ(flow.viscous.mobility, 19088744u);  // 2^32 x (2/9) x 0.02 = 19088743.5
  EXPECT_EQ(flow.viscous.yield, 65536u);
  EXPECT_EQ(flow.viscous.stiffness, 1);
  EXPECT_EQ(flow.viscous.substeps, 0);
  EXPECT_EQ(flow.viscous.substeps_max, 64);
}

TEST(Load, ClearIsANumberOrThree) {
  const SceneFolder folder;
  const auto look = [&](const std::string& keys) {
    return folder.load_text(kLeast + "[look]\n" + keys).look;
  };
  // 0x5a = 90, 0x2d = 45, 0x0c = 12. Then ((90 / 255 + 0.055) / 1.055)^2.4 = 0.10224, and so on.
  EXPECT_EQ(look("solid = \"#5a2d0c\"\n").solid, (Vec3{0.1022, 0.0262, 0.0037}));
  EXPECT_EQ(look("ground = \"#FFff00\"\n").ground, (Vec3{1, 1, 0}));
  EXPECT_EQ(look("background = \"#010a0b\"\n").background, (Vec3{0.0003, 0.003, 0.0033}));
  EXPECT_EQ(look("").clear, (Vec3{0, 0, 0}));
  EXPECT_EQ(look("").frost, 0.1);
  EXPECT_EQ(look("clear=7.5\nfrost=0.25\n").clear, (Vec3{7.5, 7.5, 7.5}));
  EXPECT_EQ(look("clear=7.5\nfrost=0.25\n").frost, 0.25);
  EXPECT_EQ(look("clear=[1,0,256]\n").clear, (Vec3{1, 0, 256}));
  EXPECT_EQ(look("glow=true\nclear=[0,0,0]\n").clear, (Vec3{}));  // an opaque look may glow
}

TEST(Overrides, ReplaceAndAddKeys) {
  const SceneFolder folder;
  const Scene scene = folder.load_text(kLeast + "[heat]\n[[heat_source]]\nat=[0,0,0]\npower=1\n",
                                       {"heat_source.0.power=3", "heat.gamma=0.2", "title=some-name",
                                        "grid.size=[9,9,9]", "flow.paper.slump=0.5", "flow.law=paper"});
  EXPECT_EQ(scene.parameters.heat.sources[0].keys[0].power, std::uint64_t{3} << 28);
  EXPECT_EQ(scene.parameters.heat.weight_face, 4172);
  EXPECT_EQ(scene.title, "some-name");
  EXPECT_EQ(scene.initial.grid.x, 9);
  EXPECT_EQ(scene.parameters.flow.paper.slump, 2048);
}

TEST(Extends, TablesMergeArraysAreReplaced) {
  const SceneFolder folder;
  folder.write(
      "base/base.toml",
      kLeast +
          "[run]\nsteps=5\nseed=6\n[flow]\nlaw='paper'\n[flow.paper]\nslump=0.5\n[flow.fall]\nfactor=0.5\n");
  const Scene scene = folder.load_text(R"(
extends = "base/base.toml"
[run]
steps = 7
[[solid]]
shape = "box"
size = [1, 1, 1]
at = [0.5, 0.5, 0.5]
[flow]
law = "viscous"
[flow.viscous]
kappa = 1
)");
  EXPECT_EQ(scene.steps, 7u);
  EXPECT_EQ(scene.parameters.seed, 6u);
  EXPECT_EQ(scene.initial.solid.count(), 1);
  EXPECT_EQ(scene.parameters.flow.fall.factor, 32768u);  // inherited; flow.paper is dropped with its law
}

TEST(Extends, ErrorsNameTheFileThatIsWrong) {
  const SceneFolder folder;
  folder.write("base.toml", kLeast + "[heat]\ngamma = 0.7\n");
  EXPECT_EQ(folder.error_of("extends = 'base.toml'\n"),
            "base.toml:8:9: error: heat.gamma = 0.7 exceeds 0.5236, the bound for 6 neighbours");
  EXPECT_EQ(folder.error_of("extends = 'base.toml'\n[heat]\ngamma = 0.1\ngama = 2\n"),
            "scene.toml:4:1: error: unknown key heat.gama; did you mean heat.gamma?");
  EXPECT_NE(folder.error_of("extends = 'scene.toml'\n").find("does a scene extend itself?"),
            std::string::npos);
  EXPECT_EQ(folder.error_of("extends = 'none.toml'\n"),
            "scene.toml:1:11: error: extends names none.toml, which does not exist");
}

TEST(Committed, EverySceneLoadsWithoutWarnings) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(committed_scenes())) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path().string());
    const Scene scene = load(entry.path(), {});
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_NE(scene.title, scene.name);
    EXPECT_TRUE(scene.initial.solid.count() + scene.initial.liquid.count() > 0 ||
                !scene.parameters.vents.empty());
    ++scenes;
  }
  EXPECT_GE(scenes, 12);
}

}  // namespace
}  // namespace voxmelt::scene
