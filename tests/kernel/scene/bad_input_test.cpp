// Bad scenes end in one clear line with its place. None is accepted, crashes or hangs.
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/kernel/scene/scene_text.h"

namespace voxmelt::scene {
namespace {

const std::string kGrid = "[grid]\nsize = [8, 8, 8]\n";
const std::string kBox =
    kGrid + "[[solid]]\nshape = \"box\"\nsize = [2, 2, 2]\nat = [4, 4, 4]\n";  // six lines

struct Case {
  std::string text;
  std::string expected;  // the beginning of the message
  std::vector<std::string> overrides = {};
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      // The document itself is wrong.
      {"", "scene.toml:1:1: error: grid.size is missing"},
      {"[grid", "scene.toml:1:6: error: "},
      {"[grid]\nsize = [8, 8, 8]\nsize = [8, 8, 8]\n", "scene.toml:3:8: error: "},
      {std::string("\xff\xfe\x00junk", 7), "scene.toml:1:1: error: "},
      {kGrid, "scene.toml:1:1: error: nothing can flow"},
      {kBox + "cut = true\n", "scene.toml:1:1: error: nothing can flow"},
      {kGrid + "solid = []\n", "scene.toml:3:1: error: unknown key grid.solid"},
      {kBox + "extends = 3\n", "scene.toml:7:1: error: unknown key solid.0.extends"},
      {"extends = 3\n" + kBox, "scene.toml:1:11: error: extends must be the name of a scene file"},
      // Keys are wrong.
      {"tittle = \"x\"\n" + kBox, "scene.toml:1:1: error: unknown key tittle; did you mean title?"},
      {kBox + "[heat]\ngama = 0.1\n",
       "scene.toml:8:1: error: unknown key heat.gama; did you mean heat.gamma?"},
      {kBox + "[hete]\n", "scene.toml:7:2: error: unknown key hete; did you mean heat?"},
      {"[grid]\nsiez = [8, 8, 8]\n", "scene.toml:2:1: error: unknown key grid.siez; did you mean grid.size?"},
      {kBox + "qqqqqqqqqqqq = 1\n", "scene.toml:7:1: error: unknown key solid.0.qqqqqqqqqqqq"},
      // Types and ranges of numbers are wrong.
      {"[grid]\nsize = [0, 8, 8]\n", "scene.toml:2:9: error: grid.size.0 = 0 is below 1"},
      {"[grid]\nsize = [8, 8, 5000]\n", "scene.toml:2:15: error: grid.size.2 = 5000 exceeds 4096"},
      {"[grid]\nsize = [8, 8]\n", "scene.toml:2:8: error: grid.size must have 3 numbers, not 2"},
      {"[grid]\nsize = [8, 8, 2.5]\n", "scene.toml:2:8: error: grid.size must be whole numbers of cells"},
      {"[grid]\nsize = 8\n",
       "scene.toml:2:8: error: grid.size must be an array of 3 numbers, not an integer"},
      {"[grid]\nsize = [8, 8, 8]\nborder = \"ajar\"\n",
       "scene.toml:3:10: error: grid.border = \"ajar\" is not one of closed, open"},
      {"[grid]\nsize = [8, 8, 8]\nborder = true\n",
       "scene.toml:3:10: error: grid.border must be a string, not true or false"},
      {"grid = 3\n", "scene.toml:1:8: error: grid must be a table, not an integer"},
      {kBox + "[heat]\ngamma = nan\n", "scene.toml:8:9: error: heat.gamma = nan is not a finite number"},
      {kBox + "[heat]\ngamma = inf\n", "scene.toml:8:9: error: heat.gamma = inf is not a finite number"},
      {kBox + "[heat]\ngamma = 0.7\n",
       "scene.toml:8:9: error: heat.gamma = 0.7 exceeds 0.5236, the bound for 6 neighbours"},
      {kBox + "[heat]\ngamma = -1\n", "scene.toml:8:9: error: heat.gamma = -1 is below 0"},
      {kBox + "[heat]\ngamma = \"hot\"\n",
       "scene.toml:8:9: error: heat.gamma must be a number, not a string"},
      {kBox + "[heat]\nneighbours = 7\n",
       "scene.toml:8:14: error: heat.neighbours = 7 is not one of 6, 18, 26"},
      {kBox + "[heat]\nrays_per_face = 9\n",
       "scene.toml:8:17: error: heat.rays_per_face = 9 is not one of 1, 4, 16"},
      {kBox + "[run]\nsteps = -1\n", "scene.toml:8:9: error: run.steps = -1 is outside 0..4294967295"},
      {kBox + "[run]\nsteps = 1.5\n", "scene.toml:8:9: error: run.steps must be an integer, not a number"},
      {kBox + "[run]\nsteps = 2024-01-01\n",
       "scene.toml:8:9: error: run.steps must be an integer, not a date"},
      {kBox + "[material]\nmelting_point = 1.5\n",
       "scene.toml:8:17: error: material.melting_point = 1.5 exceeds 1"},
      // Sources are wrong.
      {kBox + "[[heat_source]]\nat = [0, 0, 0]\npower = 1\n",
       "scene.toml:7:1: error: heat_source needs a [heat] table"},
      {kBox + "[heat]\n[heat_source]\n",
       "scene.toml:8:1: error: heat_source must be an array of tables ([[heat_source]]), not a table"},
      {kBox + "[heat]\n[[heat_source]]\nat = [0, 0, 0]\n",
       "scene.toml:8:1: error: heat_source.0.power is missing"},
      {kBox + "[heat]\n[[heat_source]]\nat = [0, 0, 0]\npower = 1e9\n",
       "scene.toml:10:9: error: heat_source.0.power = 1000000000 exceeds"},
      {kBox + "[heat]\n[[heat_source]]\nkeyframes = []\n",
       "scene.toml:9:13: error: heat_source.0.keyframes is empty"},
      {kBox +
           "[heat]\n[[heat_source]]\nkeyframes = [{step=4,at=[0,0,0],power=1},{step=4,at=[0,0,0],power=1}]\n",
       "scene.toml:9:48: error: heat_source.0.keyframes.1.step = 4 must be after the keyframe before, 4"},
      {kBox + "[heat]\n[[heat_source]]\nkind = \"moon\"\npower = 1\n",
       "scene.toml:9:8: error: heat_source.0.kind = \"moon\" is not one of"},
      {kBox + "[heat]\n[[heat_source]]\nkind = \"sphere\"\nat = [0, 0, 0]\npower = 1\n",
       "scene.toml:8:1: error: heat_source.0.radius is missing"},
      {kBox + "[heat]\n[[heat_source]]\nkind = \"sphere\"\nat = [0, 0, 0]\npower = 1\nradius = 8193\n",
       "scene.toml:12:10: error: heat_source.0.radius = 8193 exceeds 8192"},
      {kBox + "[heat]\n[[heat_source]]\nkind = \"sphere\"\nat = [0, 0, 0]\npower = 1\nradius = -1\n",
       "scene.toml:12:10: error: heat_source.0.radius = -1"},
      {kBox + "[heat]\n[[heat_source]]\nat = [0, 0, 0]\npower = 1\nradius = 1\n",
       "scene.toml:11:1: error: unknown key heat_source.0.radius"},
      {kBox + "[heat]\n[[heat_source]]\nkind = \"directional\"\npower = 1\ndirection = [0, 0, 0]\n",
       "scene.toml:11:13: error: heat_source.0.direction has no length"},
      {kBox + "[heat]\n[[heat_source]]\nkind = \"directional\"\npower = 1\ndirection = [0, 1]\n",
       "scene.toml:11:13: error: heat_source.0.direction"},
      {kBox + "[heat]\n[[heat_source]]\nkind = \"directional\"\npower = 1\nat = [0, 1, 0]\n",
       "scene.toml:8:1: error: heat_source.0.direction is missing"},
      {kBox + "[heat]\n[[heat_source]]\nkind = \"sky\"\npower = 1\nat = [0, 0, 0]\n",
       "scene.toml:11:1: error: unknown key heat_source.0.at"},
      {kBox + "[heat]\n[[heat_source]]\nkind = \"sky\"\npower = 1\nkeyframes = [{step=0,power=1}]\n",
       "scene.toml:11:13: error: heat_source.0.keyframes excludes power"},
      {kBox + "[heat]\n[[heat_source]]\nkind = \"sky\"\nkeyframes = [{step=0,power=1,radius=3}]\n",
       "scene.toml:10:30: error: unknown key heat_source.0.keyframes.0.radius"},
      {kBox + "[[vent]]\nat = [0, 0, 0]\nradius = 1\nrate = 1\nfrom = 5\nuntil = 5\n",
       "scene.toml:12:9: error: vent.0.until = 5 must be after from = 5"},
      {kBox + "[[drain]]\nat = [0, 0, 0]\nradius = 1\nrate = 2\n",
       "scene.toml:10:8: error: drain.0.rate = 2 exceeds 1, a full cell per cell and step"},
      {kBox + "[heat.air]\nexchange = 1.5e-5\nbottom = 1\n",
       "scene.toml:8:12: error: heat.air.exchange = 1.5e-05 is below 1.52587890625e-05"},
      {kBox + "[pieces]\nin_liquid = 1025\n",
       "scene.toml:8:13: error: pieces.in_liquid = 1025 is outside 1..1024"},
      {kBox + "[pieces]\ndensity = 1.5\n", "scene.toml:8:11: error: pieces.density = 1.5 exceeds 1"},
      {kBox + "[pieces]\ndensity = 0\n",
       "scene.toml:8:11: error: pieces.density = 0 is below 1.52587890625e-05"},
      // Keys for flow are wrong.
      {kBox + "[flow]\nlaw = \"honey\"\n",
       "scene.toml:8:7: error: flow.law = \"honey\" is not one of paper, viscous"},
      {kBox + "[flow]\nlaw = \"paper\"\n[flow.viscous]\nkappa = 1\n",
       "scene.toml:9:1: error: flow.viscous is not used by law = \"paper\""},
      {kBox + "[flow]\nlaw = \"viscous\"\n", "scene.toml:7:1: error: flow.viscous is missing"},
      {kBox + "[flow]\nlaw = \"viscous\"\n[flow.viscous]\nkappa = 1\nsubsteps = 0\n",
       "scene.toml:11:12: error: flow.viscous.substeps = 0 is outside 1..1024"},
      {kBox + "[flow]\nlaw = \"viscous\"\n[flow.viscous]\nkappa = 1\nstages_max = 17\n",
       "scene.toml:11:14: error: flow.viscous.stages_max = 17 is outside 1..16"},
      {kBox + "[flow]\nlaw = \"viscous\"\n[flow.viscous]\nkappa = 1\nsubsteps = \"many\"\n",
       "scene.toml:11:12: error: flow.viscous.substeps = \"many\" is not one of auto"},
      {kBox + "[flow.paper]\nshare = 0.25\n",
       "scene.toml:8:9: error: flow.paper.share = 0.25 exceeds 0.2, the bound for 8 neighbours"},
      {kBox + "[flow.paper]\nneighbours = 4\nshare = 0.26\n",
       "scene.toml:9:9: error: flow.paper.share = 0.26 exceeds 0.25, the bound for 4 neighbours"},
      {kBox + "[flow.thermal]\nreference = 0.5\ndoubling = 0.0019\n",
       "scene.toml:9:12: error: flow.thermal.doubling = 0.0019 is below 0.002"},
      {kBox + "[flow.paper]\ntable = []\n",
       "scene.toml:8:9: error: flow.paper.table needs flow.paper.neighbours = 4"},
      {kBox + "[flow.paper]\nneighbours = 4\ntable = [[0, 0, 0, 0]]\n",
       "scene.toml:9:9: error: flow.paper.table must have 16..16 rows, not 1"},
      // Shapes are wrong.
      {kGrid + "[[solid]]\n", "scene.toml:3:1: error: solid.0.shape is missing"},
      {kGrid + "[[solid]]\nshape = \"dodecahedron\"\n",
       "scene.toml:4:9: error: solid.0.shape = \"dodecahedron\" is not one of sphere,"},
      {kGrid + "[[solid]]\nshape = \"floor\"\n",
       "scene.toml:4:9: error: solid.0.shape = \"floor\" is for [[inert]] only"},
      {kGrid + "[[solid]]\nshape = \"sphere\"\nradius = 0\n",
       "scene.toml:5:10: error: solid.0.radius = 0 must be more than 0"},
      {kGrid + "[[solid]]\nshape = \"sphere\"\nradius = 1e300\n",
       "scene.toml:5:10: error: solid.0.radius = 1e+300 exceeds 65536"},
      {kGrid + "[[solid]]\nshape = \"revolve\"\nprofile = [[0, 0], [1, 1]]\n",
       "scene.toml:5:11: error: solid.0.profile must have 3..1024 rows, not 2"},
      {kGrid + "[[solid]]\nshape = \"revolve\"\nprofile = [[0, 0], [-1, 1], [2, 2]]\n",
       "scene.toml:5:11: error: solid.0.profile.1.0 = -1 is below 0"},
      {kGrid + "[[solid]]\nshape = \"extrude\"\ndepth = 1\noutline = [[0, 0], [0, 0], [0, 0]]\n",
       "scene.toml:6:11: error: solid.0.outline must have at least 3 different points"},
      {kGrid + "[[solid]]\nshape = \"csg\"\nop = \"union\"\nparts = []\n",
       "scene.toml:6:9: error: solid.0.parts is empty"},
      {kGrid + "[[solid]]\nshape = \"csg\"\nop = \"union\"\nparts = [{ shape = \"sphere\", radios = 1 }]\n",
       "scene.toml:6:30: error: unknown key solid.0.parts.0.radios; did you mean solid.0.parts.0.radius?"},
      {kGrid + "[[liquid]]\nshape = \"sphere\"\nradius = 1\namount = 1\nenergy = 2\n",
       "scene.toml:7:10: error: liquid.0.energy = 2 exceeds 1, the amount"},
      {kGrid + "[[liquid]]\nshape = \"sphere\"\nradius = 1\namount = 16\n",
       "scene.toml:6:10: error: liquid.0.amount = 16 exceeds 15"},
      {kGrid + "[[inert]]\nshape = \"floor\"\nthickness = 9\n",
       "scene.toml:5:13: error: inert.0.thickness = 9 is outside 1..8"},
      {kGrid + "[material]\nlatent_heat = 0.25\n[[inert]]\nshape = \"floor\"\ntemperature = 0.76\n",
       "scene.toml:7:15: error: inert.0.temperature = 0.76 exceeds 0.749996: latent heat takes the rest"},
      {kGrid + "[material]\nmelting_point = 0.4\nfreezing_point = 0.41\n",
       "scene.toml:5:18: error: material.freezing_point = 0.41 is above melting_point = 0.4"},
      {kGrid + "[material]\nfreezing_point = 0\n",
       "scene.toml:4:18: error: material.freezing_point = 0 must be more than 0"},
      {kGrid + "[heat]\n[heat.air]\nglow = 0.2\n",
       "scene.toml:5:8: error: heat.air.glow = 0.2 exceeds 0.16666"},
      {kGrid + "[heat]\n[heat.air]\nglow = 0\n", "scene.toml:4:1: error: heat.air.exchange is missing"},
      // Files are wrong.
      {kGrid + "[[solid]]\nshape = \"mesh\"\nfile = \"none.obj\"\nheight = 4\n",
       "scene.toml:5:8: error: cannot read none.obj: No such file or directory"},
      {kGrid + "[[solid]]\nshape = \"mesh\"\nfile = \".\"\nheight = 4\n",
       "scene.toml:5:8: error: cannot read"},
      {kBox + "[start]\nfields = \"none\"\n",
       "scene.toml:8:10: error: cannot read none/solid.npy: No such file or directory"},
      // Keys for drawing are wrong.
      {kBox + "[look]\nsolid = \"#5a2d0\"\n",
       "scene.toml:8:9: error: look.solid = \"#5a2d0\": want \"#rrggbb\", or [r, g, b] from 0 to 1"},
      {kBox + "[look]\nliquid = \"#5a2g00\"\n",
       "scene.toml:8:10: error: look.liquid = \"#5a2g00\": want \"#rrggbb\", or [r, g, b] from 0 to 1"},
      {kBox + "[look]\nsolid = [1, 1, 2]\n", "scene.toml:8:16: error: look.solid.2 = 2 exceeds 1"},
      {kBox + "[look]\nclear = 256.5\n", "scene.toml:8:9: error: look.clear = 256.5 exceeds 256"},
      {kBox + "[look]\nclear = [9, -1, 9]\n", "scene.toml:8:13: error: look.clear.1 = -1 is below 0"},
      {kBox + "[look]\nglow = true\nclear = 4\n",
       "scene.toml:9:9: error: look.clear is for matter that does not glow"},
      {kBox + "[look]\nfrost = 1.5\n", "scene.toml:8:9: error: look.frost = 1.5 exceeds 1"},
      {kBox + "[light]\ndirection = [0, 0, 0]\n", "scene.toml:8:13: error: light.direction has no length"},
      {kBox + "[camera]\nwidth = 1000000\n",
       "scene.toml:8:9: error: camera.width = 1000000 is outside 16..16384"},
      {kBox + "[camera]\nazimuth = -361\n", "scene.toml:8:11: error: camera.azimuth = -361 is below -360"},
      {kBox + "[camera]\nprojection = \"fisheye\"\n",
       "scene.toml:8:14: error: camera.projection = \"fisheye\" is not one of perspective, orthographic"},
      {kBox + "[camera]\nazimuth = 361\n", "scene.toml:8:11: error: camera.azimuth = 361 exceeds 360"},
      // Overrides are wrong.
      {kBox, "--set heat.gamma=0.7: error: heat.gamma = 0.7 exceeds 0.5236", {"heat.gamma=0.7"}},
      {kBox,
       "--set heat.gama=0.1: error: unknown key heat.gama; did you mean heat.gamma?",
       {"heat.gama=0.1"}},
      {kBox, "--set =3: error: expected path.to.key=value", {"=3"}},
      {kBox, "--set : error: expected path.to.key=value", {""}},
      {kBox, "--set heat.gamma: error: expected path.to.key=value", {"heat.gamma"}},
      {kBox, "--set heat..gamma=1: error: expected names separated by dots", {"heat..gamma=1"}},
      {kBox, "--set heat.gamma=: error: there is no value after '='", {"heat.gamma="}},
      {kBox, "--set heat.gamma=0,5: error: not a TOML value", {"heat.gamma=0,5"}},
      {kBox, "--set heat.gamma=hot: error: heat.gamma must be a number, not a string", {"heat.gamma=hot"}},
      {kBox,
       "--set solid.1.temperature=1: error: there is no solid.1: solid has 1 elements",
       {"solid.1.temperature=1"}},
      {kBox, "--set heat_source.0.power=1: error: there is no heat_source.0", {"heat_source.0.power=1"}},
      {kBox, "--set grid.size.x=1: error: grid.size is an array", {"grid.size.x=1"}},
      {kBox, "--set grid.size.0.y=1: error: grid.size.0 is an integer, not a table", {"grid.size.0.y=1"}},
  };
  return all;
}

TEST(BadInput, EndsInOneClearLine) {
  const SceneFolder folder;
  for (const Case& bad : cases()) {
    const std::string message = folder.error_of(bad.text, bad.overrides);
    EXPECT_EQ(message.substr(0, bad.expected.size()), bad.expected)
        << "scene:\n"
        << bad.text << "\nwhole message: " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(BadInput, FilesThatCannotBeRead) {
  const SceneFolder folder;
  const auto message = [&](const std::filesystem::path& file) {
    try {
      load(file, {});
    } catch (const InputError& error) {
      return folder.without_folder(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(folder.path() / "none.toml"),
            "none.toml: error: cannot read none.toml: No such file or directory");
  EXPECT_NE(message(folder.path()).find("it is a folder"), std::string::npos);
  EXPECT_EQ(message("/dev/zero"), "/dev/zero: error: cannot read /dev/zero: larger than 16777216 bytes");
}

TEST(BadInput, HugeGridsAreRefusedBeforeTheyAreAllocated) {
  const SceneFolder folder;
  try {
    folder.load_text("[grid]\nsize = [4096, 4096, 4096]\n");
    FAIL() << "accepted";
  } catch (const ResourceError& error) {
    const std::string message = folder.without_folder(error.what());
    EXPECT_EQ(
        message.rfind(
            "scene.toml:2:8: error: grid.size = [4096, 4096, 4096] needs 34359738368 bytes of memory, ", 0),
        0u)
        << message;
  }
}

TEST(BadInput, DeepNestingIsRefused) {
  const SceneFolder folder;
  std::string part = "{shape='sphere',radius=1}";
  for (int i = 0; i < 12; ++i) part.insert(0, "{shape='csg',op='union',mirror='x',parts=[").append("]}");
  const std::string message =
      folder.error_of(kGrid + "[[solid]]\nshape='csg'\nop='union'\nparts=[" + part + "]\n");
  EXPECT_NE(message.find(" = \"csg\" is nested more than 8 deep"), std::string::npos) << message;
  EXPECT_NE(folder.error_of("title = " + std::string(100000, '[')), "");
}

// Any beginning of a good scene is either accepted or refused. Nothing else happens.
TEST(BadInput, TruncatedAnywhere) {
  const SceneFolder folder;
  const std::string text = kBox +
                           "[heat]\ngamma = 0.1\n[heat.air]\nexchange = 0.1\nbottom = 0.5\n[flow]\nlaw = "
                           "\"paper\"\n[look]\nsolid = [1, 0, 1]\n";
  for (std::size_t length = 0; length < text.size(); ++length) folder.error_of(text.substr(0, length));
}

}  // namespace
}  // namespace voxmelt::scene
