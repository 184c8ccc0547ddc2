// Meshes and height fields are imported, and bad ones are refused.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "kernel/scene/shape/heightfield.h"
#include "tests/kernel/scene/scene_text.h"

namespace voxmelt::scene {
namespace {

// This unit cube has twelve triangles or six squares.
const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
const std::string kSquares = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n";
const std::string kMeshScene =
    "[grid]\nsize = [16, 16, 16]\n[[solid]]\nshape = \"mesh\"\nfile = \"m.obj\"\nheight = 8\nat = [8, 2, "
    "8]\n";

TEST(Mesh, CubeIsExact) {
  const SceneFolder folder;
  folder.write("m.obj", kCorners + kSquares);
  const Scene scene = folder.load_text(kMeshScene);
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_EQ(scene.initial.solid.count(), 512);
  EXPECT_EQ(solid_mass(scene.initial), 512);
  EXPECT_TRUE(scene.initial.solid.test(4, 2, 4));
  EXPECT_TRUE(scene.initial.solid.test(11, 9, 11));
}

// Modelling programs write the same cube in these ways.
TEST(Mesh, WhatWritersWriteIsRead) {
  const SceneFolder folder;
  const auto digest = [&](const std::string& mesh) {
    folder.write("m.obj", mesh);
    const Scene scene = folder.load_text(kMeshScene);
    EXPECT_TRUE(scene.warnings.empty()) << mesh;  // a lost face would leave open edges
    return scene.initial_digest;
  };
  const std::uint64_t plain = digest(kCorners + kSquares);
  const std::string rest = kSquares.substr(kSquares.find('\n') + 1);
  const std::vector<std::string> meshes{kCorners + "f 1 4 \\\n3 2\n" + rest,
                                        kCorners + "f 1 4\\\n3 2\n" + rest,
                                        kCorners + "f 1 4 \\\r\n 3 \\\r\n 2\r\n" + rest,
                                        kCorners + "f 1 4 3 2 # under side\n" + rest,
                                        kCorners + "f 1 4 3 2 # under side \\\n" + rest,
                                        "#first\n" + kCorners + kSquares + "# last \\",
                                        "\xef\xbb\xbf" + kCorners + kSquares};
  for (const std::string& mesh : meshes) EXPECT_EQ(digest(mesh), plain) << mesh;
}

TEST(Mesh, TurnedCubeKeepsItsVolumeAndDoesNotLeak) {
  const SceneFolder folder;
  folder.write("m.obj", kCorners + kSquares);
  for (const char* turn : {"rotate = [45, 0, 0]\n", "rotate = [10, 20, 30]\n", "rotate = [45, 45, 45]\n"}) {
    SCOPED_TRACE(turn);
    const Scene scene = folder.load_text(kMeshScene + turn, {"solid.0.height=12"});
    EXPECT_TRUE(scene.warnings.empty());
    const double side = std::cbrt(solid_mass(scene.initial));
    EXPECT_GT(side, 6.5);
    EXPECT_LT(side, 9.5);
  }
}

TEST(Mesh, AMissingSideIsClosedInTheMean) {
  const SceneFolder folder;
  folder.write("m.obj", kCorners + kSquares.substr(0, kSquares.rfind("f ")));  // open towards +x
  const Scene scene = folder.load_text(kMeshScene);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0], "m.obj: 4 open edges: the mean over six directions says what is inside");
  EXPECT_EQ(scene.initial.solid.count(), 512);
}

TEST(Mesh, BunnyIsClosed) {
  const SceneFolder folder;
  std::filesystem::copy(committed_scenes() / "data" / "bunny.obj", folder.path() / "m.obj");
  const Scene scene = folder.load_text(kMeshScene);
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_GT(solid_mass(scene.initial), 50);
}

TEST(Mesh, BadFilesAreRefusedWithTheirLine) {
  const SceneFolder folder;
  const auto error = [&](const std::string& mesh) {
    folder.write("m.obj", mesh);
    return folder.error_of(kMeshScene);
  };
  const std::string place = "scene.toml:5:8: error: m.obj";
  EXPECT_EQ(error(""), place + ": the mesh has no vertices");
  EXPECT_EQ(error(kCorners), place + ": the mesh has no faces");
  EXPECT_EQ(error("v 0 0\n"), place + ":1: a vertex needs 3 coordinates: is the file truncated?");
  EXPECT_EQ(error("v 0 nan 0\n"), place + ":1: 'nan' is not a coordinate");
  EXPECT_EQ(error("v 0 1x 0\n"), place + ":1: '1x' is not a coordinate");
  EXPECT_EQ(error("v 0x1 1 1\n"), place + ":1: '0x1' is not a coordinate");
  EXPECT_EQ(error("v 0 1e400 0\n"), place + ":1: '1e400' is not a coordinate");
  EXPECT_EQ(error("v 0 0 +-1\n"), place + ":1: '+-1' is not a coordinate");
  EXPECT_EQ(error(std::string("v 0 0 1\0002\n", 10)), place + ":1: '1\\x002' is not a coordinate");
  EXPECT_EQ(error(kCorners + "f 1 2 0x3\n"), place + ":9: '0x3' is not a vertex of a face");
  EXPECT_EQ(error(kCorners + "f 1 2 9\n"),
            place + ":9: a face names vertex 9, but 8 vertices are known here");
  EXPECT_EQ(error(kCorners + "f 1 2 0\n"),
            place + ":9: a face names vertex 0, but 8 vertices are known here");
  EXPECT_EQ(error(kCorners + "f 1 2 -9\n"),
            place + ":9: a face names vertex -9, but 8 vertices are known here");
  EXPECT_EQ(error(kCorners + "f 1 2\n"), place + ":9: a face needs 3 corners, not 2: is the file truncated?");
  EXPECT_EQ(error(kCorners + "f 1 \\\n 2 \\\n x\n"), place + ":11: 'x' is not a vertex of a face");
  EXPECT_EQ(error(std::string("\xff\xfev\0", 4)),
            place + ": this is UTF-16; write the file as plain text or UTF-8");
  EXPECT_EQ(error(kCorners + "f a b c\n"), place + ":9: 'a' is not a vertex of a face");
  EXPECT_EQ(error("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n"),
            "scene.toml:6:10: error: solid.0.height: m.obj has no height to scale");
}

const std::string kHillScene =
    "[grid]\nsize = [16, 16, 16]\n[[inert]]\nshape = \"heightfield\"\nfile = \"h.asc\"\nvertical_scale = "
    "1\nbase = 2.25\n"
    "[[vent]]\nat = [8, 8, 8]\nradius = 1\nrate = 1\n";

TEST(Heightfield, BedOffsetsHoldTheFraction) {
  const SceneFolder folder;
  folder.write("h.asc", "ncols 3\nnrows 2\nNODATA_value -9999\n0 4 8\n0 4 8\n");
  const Scene scene = folder.load_text(kHillScene, {"inert.0.smooth=0"});
  const state::Volume& volume = scene.initial;
  EXPECT_TRUE(scene.terrain.textured);
  EXPECT_NEAR(scene.terrain.height[0], 2.25, 0.75);
  for (int z = 0; z < 16; ++z)
    for (int x = 0; x < 16; ++x) {
      const float height = scene.terrain.height[static_cast<std::size_t>(z * 16 + x)];
      const int ground = static_cast<int>(std::lround(height));
      for (int y = 0; y < 16; ++y) EXPECT_EQ(volume.inert.test(x, y, z), y < ground);
      const double bed = volume.amount[volume.at(x, ground - 1, z)];
      EXPECT_NEAR(ground - 0.5 + bed / 4096, height, 0.001);  // the bed says where the ground is
      if (x > 0) {
        EXPECT_GT(height, scene.terrain.height[static_cast<std::size_t>(z * 16 + x - 1)]);  // no terraces
      }
    }
}

TEST(Heightfield, FlatGroundHasNoOffset) {
  const SceneFolder folder;
  folder.write("h.asc", "ncols 2\nnrows 2\n7 7\n7 7\n");
  const Scene scene = folder.load_text(kHillScene, {"inert.0.base=3"});
  EXPECT_EQ(scene.initial.inert.count(), 3 * 16 * 16);
  EXPECT_EQ(scene.initial.amount[scene.initial.at(5, 2, 5)], 2048);
}

// The heights are smoothed once, as docs/scenes.md says, unless the scene says otherwise.
TEST(Heightfield, IsSmoothedOnce) {
  const SceneFolder folder;
  folder.write("h.asc", "ncols 3\nnrows 3\n0 0 0\n0 8 0\n0 0 0\n");
  const auto heights = [&](const std::vector<std::string>& sets) {
    return folder.load_text(kHillScene, sets).terrain.height;
  };
  const std::vector<float> usual = heights({});
  EXPECT_EQ(usual, heights({"inert.0.smooth=1"}));
  EXPECT_NE(usual, heights({"inert.0.smooth=0"}));
  EXPECT_NE(usual, heights({"inert.0.smooth=2"}));
}

TEST(Heightfield, OfTwoGroundsTheHigherOneCounts) {
  const SceneFolder folder;
  folder.write("h.asc", "ncols 2\nnrows 2\n7 7\n7 7\n");
  const std::string hill = kHillScene.substr(kHillScene.find("[[inert]]")),
                    grid = "[grid]\nsize = [16, 16, 16]\n";
  for (const auto& [thickness, expected] : {std::pair{3, 5}, std::pair{7, 7}}) {
    const std::string floor = "[[inert]]\nshape = \"floor\"\nthickness = " + std::to_string(thickness) + "\n";
    for (const bool first : {false, true}) {
      std::string text = grid;
      text.append(first ? floor : hill).append(first ? hill : floor);
      const Scene scene = folder.load_text(text, {first ? "inert.1.base=5" : "inert.0.base=5"});
      EXPECT_FLOAT_EQ(scene.terrain.height[40], static_cast<float>(expected)) << thickness << first;
      EXPECT_EQ(scene.initial.inert.count(), expected * 16 * 16) << thickness << first;
    }
  }
}

// A surface half a cell below its upper face has offset 0, but 1 as a wall, because no cell of amount 0 holds
// heat.
TEST(Heightfield, AWallHasAnOffset) {
  const SceneFolder folder;
  folder.write("h.asc", "ncols 2\nnrows 2\n7 7\n7 7\n");
  for (const int wall : {0, 1}) {
    std::vector<std::string> sets{"inert.0.base=2.5", "heat.gamma=0.1"};
    if (wall) sets.emplace_back("inert.0.temperature=0.5");
    const Scene scene = folder.load_text(kHillScene, sets);
    const state::Slot top = scene.initial.at(5, 2, 5);
    EXPECT_EQ(scene.initial.amount[top], wall);
    EXPECT_EQ(scene.initial.heat[top], wall * 32768);
  }
}

TEST(Heightfield, CellsWithoutDataAreLowestAndSaidSo) {
  const SceneFolder folder;
  folder.write("h.asc", "ncols 2\nnrows 2\nNODATA_value -9999\n5 -9999\n5 5\n");
  const Scene scene = folder.load_text(kHillScene);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(folder.without_folder(scene.warnings[0]),
            "h.asc: 1 cells without data take the lowest elevation");
  EXPECT_FLOAT_EQ(scene.terrain.height[0], 2.25f);
}

// Many programs write one grid: lines end as in DOS, sizes go along two axes, and there are signs, a byte
// order mark and a last Ctrl-Z. Every way to say that the second cell has no elevation occurs.
TEST(Heightfield, WhatWritersWriteIsRead) {
  const SceneFolder folder;
  const auto values = [&](const std::string& grid) {
    folder.write("h.asc", grid);
    return read_esri_ascii(folder.path() / "h.asc", {}).value;
  };
  const std::string sides = "ncols 2\nnrows 2\n";
  const std::vector<double> whole{5, 7.5, -3, 0.25};
  const std::vector<std::string> grids{
      sides + "5 7.5\n-3 0.25\n", std::string("NCOLS 2\r\nNROWS 2\r\nCELLSIZE 30\r\n5 7.5\r\n-3 0.25\r\n"),
      "\xef\xbb\xbf" + sides + "5 7.5 -3 0.25", sides + "5 7.5\n-3 0.25\n\x1a",
      sides + "dx 10\ndy 20.5\nxllcenter 1e6\nyllcenter -2.5E+05\n+5 75e-1 -3 .25\n"};
  for (const std::string& grid : grids) EXPECT_EQ(values(grid), whole) << grid;
  const std::vector<double> lowest{5, -3, -3, 0.25};
  for (const auto& [name, word] : std::vector<std::pair<std::string, std::string>>{
           {"-9999", "-9999"},
           {"-9999.0", "-9999"},
           {"-3.4028234663852886e+38", "-3.4028234663852886e+38"},
           {"1e20", "1e+20"},
           {"nan", "nan"},
           {"-9999", "NaN"},
           {"null", "null"},
           {"-2147483648", "-2147483648"}}) {
    std::string grid = sides;
    grid.append("NODATA_value ").append(name).append("\n5 ").append(word).append("\n-3 0.25\n");
    EXPECT_EQ(values(grid), lowest) << name;
  }
  EXPECT_EQ(values(sides + "NODATA_value -3\n5 7.5\n-3 0.25\n"), (std::vector<double>{5, 7.5, 0.25, 0.25}));
  EXPECT_EQ(values(sides + "nan 7.5\n-3 0.25\n"), (std::vector<double>{-3, 7.5, -3, 0.25}));
  // Kinds of no number, notes and comments, and line ends, as found in public files.
  for (const char* word : {"NA", "-1.#IND", "1.#QNAN", "+nan", "-nan(ind)", "NAN"})
    EXPECT_EQ(values(sides + "5 " + word + "\n-3 0.25\n"), lowest) << word;
  EXPECT_EQ(values(sides + "nodata_value -inf\n5 -inf\n-3 0.25\n"), lowest);
  EXPECT_EQ(values(sides + "nodata_value -1.79769313486232e+308\n5 -1.79769313486232e+308\n-3 0.25\n"),
            lowest);
  EXPECT_EQ(values(sides + "nodata_value -3.4e+38\n5 -3.3999999521443642e+38\n-3 0.25\n"), lowest);
  EXPECT_EQ(values(sides + "5 1e-400\n-3 0.25\n"), (std::vector<double>{5, 0, -3, 0.25}));
  for (const std::string& grid :
       {"# a map\n" + sides + "# of heights\n5 7.5\n#\n-3 0.25\n",
        sides + "5 7.5\n-3 0.25\nPROJECTION LATLONG\nNOTES 1 2 3\n",
        std::string("ncols 2\rnrows 2\r5 7.5\r-3 0.25\r"), sides + "5 7.5\n-3 0.25\n" + std::string(9, '\0')})
    EXPECT_EQ(values(grid), whole) << grid;
  // The usual number means nothing if the file names another one.
  EXPECT_EQ(values(sides + "NODATA_value 0\n5 -9999\n-3 0.25\n"), (std::vector<double>{5, -9999, -3, 0.25}));
}

TEST(Heightfield, RowsOfTheUsualNumberAreNoPits) {
  const SceneFolder folder;
  folder.write("h.asc", "ncols 2\nnrows 2\n5 -9999\n5 5\n");
  const Scene scene = folder.load_text(kHillScene);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(folder.without_folder(scene.warnings[0]),
            "h.asc: 1 cells without data (-9999; no NODATA_value is named) take the lowest elevation");
}

TEST(Heightfield, AMapThatIsStretchedIsSaid) {
  const SceneFolder folder;
  folder.write("h.asc", "ncols 5\nnrows 2\ncellsize 10\n1 1 1 1 1\n1 1 1 1 1\n");
  const Scene scene = folder.load_text(kHillScene);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(folder.without_folder(scene.warnings[0]),
            "h.asc: a map of 50 x 20 is stretched over 16 x 16 cells");
  folder.write("h.asc", "ncols 5\nnrows 2\ndx 10\ndy 20\n1 1 1 1 1\n1 1 1 1 1\n");
  EXPECT_TRUE(folder.load_text(kHillScene).warnings.empty());
}

TEST(Heightfield, BadFilesAreRefusedWithTheirLine) {
  const SceneFolder folder;
  const auto error = [&](const std::string& grid) {
    folder.write("h.asc", grid);
    return folder.error_of(kHillScene);
  };
  const std::string place = "scene.toml:5:8: error: h.asc";
  EXPECT_EQ(error(""), place + ":0: the file ends before its elevations");
  EXPECT_EQ(error("ncols 2\nnrows 2\n1 2\n3\n"), place + ":4: the file ends after 3 of 4 elevations");
  EXPECT_EQ(error("ncols 2\nnrows 2\n1 2\n3 4 5\n"), place + ":4: more than 2 x 2 elevations");
  EXPECT_EQ(error("ncols 2\nnrows 2\n1 x\n3 4\n"), place + ":3: 'x' is not a number");
  EXPECT_EQ(error("ncols 2\nnrows nan\n1 2\n"), place + ":2: 'nan' is not a number");
  EXPECT_EQ(error("ncols -2\n1 2\n"), place + ":1: ncols = -2 is outside 2..8192");
  EXPECT_EQ(error("ncols 1e9\nnrows 1e9\n1 2\n"), place + ":1: ncols = 1e9 is outside 2..8192");
  EXPECT_EQ(error("1 2 3\n"), place + ":1: ncols and nrows must come before the elevations");
  EXPECT_EQ(error("wide 2\n1 2 3\n"), place + ":1: unknown header 'wide'");
  EXPECT_EQ(error("ncols 2\nnrows 2\n1,5 2\n3 4\n"),
            place + ":3: '1,5' is not a number: decimals begin with a point");
  EXPECT_EQ(error("ncols 2\nnrows 2\ncellsize 10 10.5\n1 2\n3 4\n"),
            place + ":3: cellsize has one value, and not '10.5' as well");
  EXPECT_EQ(error("ncols 2\nnrows 2\ndx 0\n1 2\n3 4\n"), place + ":3: dx = 0 is no size");
  EXPECT_EQ(
      error("ncols 2\nnrows 2\n1 1e20\n3 4\n"),
      place + ":3: '1e20' is no elevation; where it means that there is none, NODATA_value must name it");
  EXPECT_EQ(
      error("ncols 2\nnrows 2\n1 1e999\n3 4\n"),
      place + ":3: '1e999' is no elevation; where it means that there is none, NODATA_value must name it");
  EXPECT_EQ(error("ncols 2\nnrows 2\ndx 1e999\n1 2\n3 4\n"), place + ":3: '1e999' is not a number");
  EXPECT_EQ(
      error("2 ncols\n2 nrows\n1 2\n3 4\n"),
      place + ":1: '2' stands before 'ncols', which it belongs to: a key comes first, and then its value");
  EXPECT_EQ(error("DSAA\n2 2\n"),
            place + ":1: this is a grid of Surfer; `gdal_translate -of AAIGrid` converts it");
  EXPECT_EQ(error("north: 4\nsouth: 0\n"),
            place + ":1: this is a grid of GRASS; `gdal_translate -of AAIGrid` converts it");
  EXPECT_EQ(error("version https://git-lfs.github.com/spec/v1\n"),
            place + ": this is a pointer of Git LFS; `git lfs pull` brings the file");
  EXPECT_EQ(error("PK\3\4..."), place + ": this is a packed file; unpack it first");
  EXPECT_EQ(error("ncols 2\nnrows 2\n1 \x01x\n3 4\n"), place + ":3: '\\x01x' is not a number");
  EXPECT_EQ(error(std::string("n\0c\0", 4)),
            place + ": this is UTF-16; write the file as plain text or UTF-8");
  EXPECT_EQ(error(std::string("\xff\xfen\0c\0", 6)),
            place + ": this is UTF-16; write the file as plain text or UTF-8");
  EXPECT_EQ(error("ncols 2\nnrows 2\nnodata_value 1\n1 1\n1 1\n"), place + ":5: every cell is without data");
  EXPECT_EQ(error("ncols 2\nnrows 2\n0 100\n0 100\n")
                .rfind("scene.toml:6:18: error: inert.0.vertical_scale = 1 raises the terrain to ", 0),
            0u);
}

}  // namespace
}  // namespace voxmelt::scene
