// These meshes have faults. The cells are those of the bodies that the mesh was made of, and the warning
// names the fault.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/kernel/scene/mesh_files.h"
#include "tests/kernel/scene/mesh_text.h"
#include "tests/kernel/scene/scene_text.h"

namespace voxmelt::scene {
namespace {

constexpr int kSide = 32;
using Lines = std::vector<std::string>;

class BadMesh : public testing::Test {
 protected:
  // Expects that at most 1 % of the body's cells differ: cells that are solid in the scene but not in the
  // body, or the other way round. A cell belongs to the body if at least 4 of its 64 samples are inside.
  void expect(
      const MeshText& mesh, const Body& body, const Lines& warnings, const std::string& keys = "",
      const std::function<Corner(Corner)>& moved = [](Corner c) { return c; }) {
    const auto [low, high] = mesh.bounds();
    folder_.write("m.obj", mesh.text(moved));
    const Scene scene = folder_.load_text(fmt::format(
        "[grid]\nsize = [{0}, {0}, {0}]\n[[solid]]\nshape = \"mesh\"\nfile = \"m.obj\"\nheight = {1}\n"
        "at = [{2}, {3}, {4}]\n{5}",
        kSide, high[1] - low[1], (low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2, keys));
    EXPECT_EQ(scene.warnings, warnings);
    int cells = 0, wrong = 0, mass = 0;
    for (int z = 0; z < kSide; ++z)
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
          int samples = 0;
          for (int i = 0; i < 64; ++i)
            samples +=
                body(x + ((i & 3) + 0.5) / 4, y + ((i >> 2 & 3) + 0.5) / 4, z + ((i >> 4) + 0.5) / 4) ? 1 : 0;
          cells += samples >= 4 ? 1 : 0;
          mass += samples >= 4 ? samples : 0;
          wrong += (samples >= 4) != scene.initial.solid.test(x, y, z) ? 1 : 0;
        }
    EXPECT_GT(cells, 100);
    EXPECT_LE(wrong, cells / 100) << "of " << cells;
    EXPECT_NEAR(solid_mass(scene.initial), mass / 64.0, 0.015 * mass / 64.0);
    expect_the_same_of_each_format(mesh, moved, keys);
  }

  // Expects of each other format what the same mesh gives as OBJ: the same bits, and the same warnings. STL
  // and glTF know triangles of floats alone, and a vertex of STL has a face.
  void expect_the_same_of_each_format(const MeshText& mesh, const std::function<Corner(Corner)>& moved,
                                      const std::string& keys) {
    MeshText here = mesh;
    for (Corner& vertex : here.vertices) vertex = moved(vertex);
    const auto load = [&](const std::string& name, const std::string& bytes) {
      folder_.write(name, bytes);
      Scene scene = folder_.load_text(fmt::format(
          "[grid]\nsize = [{0}, {0}, {0}]\n[[solid]]\nshape = \"mesh\"\nfile = \"{1}\"\nheight = 24\n"
          "at = [16, 4, 16]\n{2}",
          kSide, name, keys));
      for (std::string& warning : scene.warnings)
        if (warning.starts_with(name)) warning.erase(0, name.size());
      return std::pair(scene.initial_digest, scene.warnings);
    };
    const auto polygons = load("m.obj", here.text());
    EXPECT_EQ(load("m.ply", ply_text(here)), polygons);
    EXPECT_EQ(load("m.ply", ply_bytes(here, false)), polygons);
    EXPECT_EQ(load("m.ply", ply_bytes(here, true)), polygons);
    const MeshText floats = as_triangles(here);
    const MeshText used = without_unused(floats);
    if (const auto [low, high] = used.bounds(); high[1] == low[1]) return;  // floats cannot say it
    const auto triangles = load("m.obj", floats.text());
    EXPECT_EQ(load("m.glb", glb_bytes(gltf_text(floats, ""))), triangles);
    const auto all_used = load("m.obj", used.text());
    EXPECT_EQ(load("m.stl", stl_text(used)), all_used);
    EXPECT_EQ(load("m.stl", stl_bytes(used)), all_used);
  }

  SceneFolder folder_;
};

const std::string kMean = ": the mean over six directions says what is inside";
const std::string kOverlap = "m.obj: shells overlap, or one crosses itself: united";

TEST_F(BadMesh, Open) {
  MeshText mesh;
  mesh.ball({16, 16, 16}, 11);
  std::erase_if(mesh.faces, [&](const std::vector<int>& face) {  // makes a hole of 3 cells in its side
    return std::hypot(mesh.vertices[static_cast<std::size_t>(face[0])][1] - 16,
                      mesh.vertices[static_cast<std::size_t>(face[0])][2] - 16) < 3 &&
           mesh.vertices[static_cast<std::size_t>(face[0])][0] > 16;
  });
  const std::size_t removed = MeshText::ball_faces - mesh.faces.size();
  ASSERT_GT(removed, 5u);
  const auto unused = std::count_if(mesh.vertices.begin(), mesh.vertices.end(), [&](const Corner& vertex) {
    return std::none_of(mesh.faces.begin(), mesh.faces.end(), [&](const std::vector<int>& face) {
      return std::any_of(face.begin(), face.end(), [&](int corner) {
        return &mesh.vertices[static_cast<std::size_t>(corner)] == &vertex;
      });
    });
  });
  int edges = 0;  // open edges, which lie in one face only
  for (std::size_t i = 0; i < mesh.faces.size(); ++i)
    for (std::size_t k = 0; k < mesh.faces[i].size(); ++k) {
      const int a = mesh.faces[i][k], b = mesh.faces[i][(k + 1) % mesh.faces[i].size()];
      bool met = false;
      for (const auto& other : mesh.faces)
        for (std::size_t m = 0; m < other.size(); ++m)
          met |= other[m] == b && other[(m + 1) % other.size()] == a;
      edges += met ? 0 : 1;
    }
  expect(mesh, ball_body({16, 16, 16}, 11),
         {fmt::format("m.obj: {} open edges{}", edges, kMean),
          fmt::format("m.obj: {} vertices without a face", unused)});
}

// For a lone triangle, a sample is inside if the lines through it along all three axes cross the triangle. On
// its side of the plane their signs agree.
TEST_F(BadMesh, ALoneTriangle) {
  const std::array<std::array<Corner, 3>, 4> triangles{{{{{1, 2, 3}, {30, 5, 28}, {4, 31, 17}}},
                                                        {{{30, 1, 2}, {2, 8, 30}, {9, 30, 1}}},
                                                        {{{2, 30, 29}, {31, 16, 3}, {5, 1, 8}}},
                                                        {{{1.5, 9, 30.5}, {16, 30, 1}, {30.25, 1.75, 22}}}}};
  for (const auto& t : triangles) {
    MeshText mesh;
    mesh.vertices.assign(t.begin(), t.end());
    mesh.faces = {{0, 1, 2}};
    const Body body = [&](double x, double y, double z) {
      const Corner p{x, y, z};
      for (std::size_t u = 0; u < 3; ++u) {
        const std::size_t v = (u + 1) % 3;
        int left = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          const Corner &a = t[i], &b = t[(i + 1) % 3];
          left += (b[u] - a[u]) * (p[v] - a[v]) > (b[v] - a[v]) * (p[u] - a[u]) ? 1 : 0;
        }
        if (left % 3 != 0) return false;
      }
      return true;
    };
    expect(mesh, body, {"m.obj: 3 open edges" + kMean});
  }
}

TEST_F(BadMesh, ABoxWithoutThreeOfItsSides) {
  MeshText mesh;
  mesh.box({6, 4, 8}, {20, 16, 12});
  mesh.faces = {mesh.faces[0], mesh.faces[2], mesh.faces[4]};
  expect(mesh, box_body({6, 4, 8}, {20, 16, 12}),
         {"m.obj: 6 open edges" + kMean, "m.obj: 1 vertex without a face"});
}

// The ball is open below its two flat sides. Rays along y and z meet one surface, so those along x decide.
TEST_F(BadMesh, AQuarterOfABall) {
  MeshText mesh;
  mesh.ball({16, 16, 16}, 11);
  std::erase_if(mesh.faces, [&](const std::vector<int>& face) {
    return std::any_of(face.begin(), face.end(), [&](int corner) {
      const Corner& c = mesh.vertices[static_cast<std::size_t>(corner)];
      return c[1] > 16.001 || c[2] > 16.001;
    });
  });
  // There are 16 of 31 rings left, with 33 of 64 corners, and a pole. A half circle along each flat side is
  // open.
  const Body above = box_body({0, 16, 0}, {32, 16, 32}), behind = box_body({0, 0, 16}, {32, 32, 16});
  expect(mesh, ball_body({16, 16, 16}, 11) - above - behind,
         {"m.obj: 64 open edges" + kMean, "m.obj: 1457 vertices without a face"});
}

TEST_F(BadMesh, Flipped) {
  MeshText mesh;
  mesh.ball({16, 16, 16}, 11);
  std::size_t flipped = 0;
  for (std::size_t i = 0; i < mesh.faces.size(); i += 7, ++flipped) mesh.turn(i);
  expect(mesh, ball_body({16, 16, 16}, 11), {fmt::format("m.obj: {} flipped faces: turned", flipped)});
}

TEST_F(BadMesh, InsideOut) {
  MeshText mesh;
  mesh.ball({12, 16, 16}, 8).ball({19, 16, 16}, 9).turn_from(MeshText::ball_faces);
  expect(mesh, ball_body({12, 16, 16}, 8) | ball_body({19, 16, 16}, 9),
         {"m.obj: 2 shells", "m.obj: 1 shell inside out: turned", kOverlap});
  MeshText other;
  other.ball({16, 16, 16}, 11).turn_from(0);
  expect(other, ball_body({16, 16, 16}, 11), {"m.obj: 1 shell inside out: turned"});
}

TEST_F(BadMesh, Double) {
  MeshText mesh;
  mesh.box({5, 5, 5}, {9, 20, 17});
  for (const auto& face : std::vector(mesh.faces)) {
    mesh.faces.push_back({face[2], face[3], face[0], face[1]});
  }
  expect(mesh, box_body({5, 5, 5}, {9, 20, 17}), {"m.obj: 6 double faces: counted once"});
}

TEST_F(BadMesh, WrittenFromBothSides) {
  MeshText mesh;
  mesh.ball({16, 16, 16}, 11);
  const std::size_t faces = mesh.faces.size();
  for (const auto& face : std::vector(mesh.faces)) mesh.faces.push_back(face);
  mesh.turn_from(faces);
  expect(mesh, ball_body({16, 16, 16}, 11), {fmt::format("m.obj: {} double faces: counted once", faces)});
}

TEST_F(BadMesh, BodiesThatShareAWall) {
  MeshText mesh;
  mesh.box({4, 4, 4}, {8, 10, 10}).box({12, 4, 4}, {8, 10, 10}).box({20, 4, 4}, {8, 10, 10});
  expect(mesh, box_body({4, 4, 4}, {24, 10, 10}), {"m.obj: 2 double faces: counted once"});
}

TEST_F(BadMesh, Overlapping) {
  MeshText mesh;
  mesh.box({4, 4, 4}, {14, 14, 14}).box({11, 11, 11}, {14, 14, 14}).ball({18, 9, 16}, 7);
  expect(mesh,
         box_body({4, 4, 4}, {14, 14, 14}) | box_body({11, 11, 11}, {14, 14, 14}) | ball_body({18, 9, 16}, 7),
         {"m.obj: 3 shells", kOverlap});
}

// A star of five points is drawn in one line, and winds twice around its middle. A place is inside if it is
// left of at least four of the five lines.
TEST_F(BadMesh, SelfIntersecting) {
  std::vector<std::array<double, 2>> star;
  for (int i = 0; i < 5; ++i) {
    const double turn = 2 * std::numbers::pi * 2 * i / 5;
    star.push_back({16 + 14 * std::cos(turn), 16 - 14 * std::sin(turn)});
  }
  const Body body = [star](double x, double y, double z) {
    int left = 0;
    for (std::size_t i = 0; i < 5; ++i) {
      const auto &a = star[i], &b = star[(i + 1) % 5];
      left += (b[0] - a[0]) * (z - a[1]) - (b[1] - a[1]) * (x - a[0]) < 0 ? 1 : 0;
    }
    return y > 0 && y < 20 && left >= 4;
  };
  MeshText mesh;
  mesh.prism(star, 20);
  expect(mesh, body, {kOverlap});
}

TEST_F(BadMesh, Degenerate) {
  MeshText mesh;
  mesh.box({6, 6, 6}, {16, 12, 18});
  mesh.vertices.push_back({10, 6, 6});  // on an edge of the box
  mesh.faces.push_back({0, 0, 1});      // only two different corners
  mesh.faces.push_back({3, 3, 3});      // only one corner
  mesh.faces.push_back({0, 8, 1});      // a line, which leaves its edges open
  expect(mesh, box_body({6, 6, 6}, {16, 12, 18}),
         {"m.obj: 2 shells", "m.obj: 1 shell without volume", "m.obj: 2 open edges" + kMean,
          "m.obj: 1 edge of more than two faces", "m.obj: 3 faces without area"});
}

TEST_F(BadMesh, Unreferenced) {
  MeshText mesh;
  mesh.vertices = {{-1e9, 5, 5}, {1e9, 0, 0}};
  mesh.box({6, 6, 6}, {16, 12, 18});
  expect(mesh, box_body({6, 6, 6}, {16, 12, 18}), {"m.obj: 2 vertices without a face"});
}

TEST_F(BadMesh, PolygonsThatAreNotConvex) {
  MeshText mesh;  // an L, then a U
  mesh.prism({{4, 28}, {28, 28}, {28, 20}, {12, 20}, {12, 4}, {4, 4}}, 20);
  expect(mesh, box_body({4, 0, 4}, {8, 20, 24}) | box_body({4, 0, 20}, {24, 20, 8}), {});
  MeshText other;
  other.prism({{4, 28}, {28, 28}, {28, 4}, {20, 4}, {20, 20}, {12, 20}, {12, 4}, {4, 4}}, 9);
  expect(other, box_body({4, 0, 4}, {24, 9, 24}) - box_body({12, -1, 3}, {8, 11, 17}), {},
         "rotate = [0, 0, 0]\n");
}

// The polygon has 20,000 corners on a circle. Every second one lies further in.
TEST_F(BadMesh, PolygonOfManyCorners) {
  std::vector<std::array<double, 2>> outline;
  for (int i = 0; i < 20000; ++i) {
    const double turn = 2 * std::numbers::pi * i / 20000, radius = i % 2 == 0 ? 12 : 11.9;
    outline.push_back({16 + radius * std::cos(turn), 16 - radius * std::sin(turn)});
  }
  MeshText mesh;
  mesh.prism(outline, 10);
  expect(mesh,
         [](double x, double y, double z) { return y > 0 && y < 10 && std::hypot(x - 16, z - 16) < 11.95; },
         {});
}

TEST_F(BadMesh, FarFromTheOriginAndOfAnySize) {
  MeshText mesh;
  mesh.ball({16, 16, 16}, 11);
  for (const double scale : {1e-6, 1e6, 1e-25, 1e25})
    expect(mesh, ball_body({16, 16, 16}, 11), {}, "", [=](Corner c) -> Corner {
      return {c[0] * scale, c[1] * scale, c[2] * scale};
    });
  for (const double far : {1e6, -1e9})
    expect(mesh, ball_body({16, 16, 16}, 11), {}, "", [=](Corner c) -> Corner {
      return {c[0] + far, c[1] - far, c[2] + 3 * far};
    });
}

TEST_F(BadMesh, NonManifold) {
  MeshText mesh;  // two boxes that share an edge; one is inside out
  mesh.box({4, 4, 4}, {10, 10, 20}).box({14, 14, 4}, {10, 10, 20}).turn_from(6);
  expect(mesh, box_body({4, 4, 4}, {10, 10, 20}) | box_body({14, 14, 4}, {10, 10, 20}),
         {"m.obj: 2 shells", "m.obj: 1 shell inside out: turned", "m.obj: 1 edge of more than two faces"});
}

TEST_F(BadMesh, APartitionInside) {
  MeshText mesh, right;
  mesh.box({4, 4, 4}, {8, 10, 10});
  right.box({12, 4, 4}, {12, 10, 10});
  right.faces.erase(right.faces.begin());  // the wall is written once, by the left box
  for (auto face : right.faces) {
    for (int& corner : face) corner += 8;
    mesh.faces.push_back(face);
  }
  mesh.vertices.insert(mesh.vertices.end(), right.vertices.begin(), right.vertices.end());
  expect(mesh, box_body({4, 4, 4}, {20, 10, 10}), {"m.obj: 4 edges of more than two faces"});
}

// The edges of the box are 4 (16 + 12 + 18) = 184 cells long, those of the flat shell 4 x 12 + 2 x 16.97
// = 81.9. So 81.9 / 265.9 = 31 % of all edges vanish.
TEST_F(BadMesh, EmptyShell) {
  MeshText mesh;
  mesh.box({6, 6, 6}, {16, 12, 18});
  mesh.vertices.insert(mesh.vertices.end(), {{8, 20, 8}, {20, 20, 8}, {20, 20, 20}, {8, 20, 20}});
  for (const auto& face :
       {std::array{8, 9, 10}, {8, 10, 11}, {8, 11, 9}, {9, 11, 10}})  // both diagonals of a square
    mesh.faces.push_back({face[0], face[1], face[2]});
  expect(mesh, box_body({6, 6, 6}, {16, 12, 18}),
         {"m.obj: 2 shells", "m.obj: 1 shell without volume",
          "m.obj: parts thinner than a quarter of a cell vanish, 31 % of its edges; a larger height or scale "
          "keeps them"});
}

// A shell that points inward within another one is a cavity. A shell within the cavity is matter again.
TEST_F(BadMesh, Cavities) {
  const Body hollow =
      (ball_body({16, 16, 16}, 13) - box_body({10, 10, 10}, {12, 12, 12})) | ball_body({16, 16, 16}, 4);
  MeshText mesh;
  mesh.ball({16, 16, 16}, 13)
      .box({10, 10, 10}, {12, 12, 12})
      .turn_from(MeshText::ball_faces)
      .ball({16, 16, 16}, 4);
  expect(mesh, hollow, {"m.obj: 3 shells, of which 1 is a cavity"});
  mesh.turn_from(0);  // turns all of it inside out
  expect(mesh, hollow, {"m.obj: 3 shells, of which 1 is a cavity", "m.obj: 3 shells inside out: turned"});
}

TEST_F(BadMesh, NestedShellsUniteOrAreHolesByParity) {
  MeshText mesh;
  mesh.ball({16, 16, 16}, 13).box({10, 10, 10}, {12, 12, 12});
  expect(mesh, ball_body({16, 16, 16}, 13), {"m.obj: 2 shells", kOverlap});
  expect(mesh, ball_body({16, 16, 16}, 13) - box_body({10, 10, 10}, {12, 12, 12}), {"m.obj: 2 shells"},
         "inside = \"parity\"\n");
}

TEST_F(BadMesh, FacesOfOneOrTwoCornersAreLeftOut) {
  MeshText mesh;
  mesh.box({11, 11, 11}, {10, 10, 10});
  const auto warnings = [&](const std::string& more) {
    folder_.write("m.obj", mesh.text() + more);
    return folder_
        .load_text(
            fmt::format("[grid]\nsize = [{0}, {0}, {0}]\n[[solid]]\nshape = \"mesh\"\nfile = \"m.obj\"\n"
                        "height = 10\nat = [16, 11, 16]\n",
                        kSide))
        .warnings;
  };
  EXPECT_EQ(warnings("f 1 2\nf 3\nv 12 12 12\n"),
            (Lines{"m.obj: 2 faces of one or two corners: left out", "m.obj: 1 vertex without a face"}));
  EXPECT_EQ(warnings("v 1e-400 12 12\n"), Lines{"m.obj: 1 vertex without a face"})
      << "too small a number is 0";
  EXPECT_THROW(warnings("f 1 2"), InputError) << "at the end the file is truncated";
}

// The edges of a cube are 120 cells long, and those of the sail on it 72.4: two of 8 and two of 10 cells on
// either side, and four across. Each belongs to two faces. The sail lies between two layers of samples. Its
// lowest edges, and half a cell of the upright ones, lie beside the cube. So 50 of 192 cells leave nothing:
// 26 %.
TEST_F(BadMesh, ThinPartsThatVanishAreSaid) {
  const auto warnings = [&](const char* role, double from, double thick) {
    MeshText mesh;
    mesh.box({11, 11, 11}, {10, 10, 10}).box({11, 21, from}, {10, 8, thick});
    folder_.write("m.obj", mesh.text());
    Lines found = folder_
                      .load_text(fmt::format("[grid]\nsize = [{0}, {0}, {0}]\n[[{1}]]\nshape = \"mesh\"\n"
                                             "file = \"m.obj\"\nheight = 18\nat = [16, 11, 16]\n"
                                             "[[solid]]\nshape = \"box\"\nsize = [2, 2, 2]\nat = [2, 2, 2]\n",
                                             kSide, role))
                      .warnings;
    std::erase(found, "m.obj: 2 shells");
    return found;
  };
  const Lines thin = warnings("solid", 15.4, 0.1);
  ASSERT_EQ(thin.size(), 1u);
  EXPECT_EQ(thin[0],
            "m.obj: parts thinner than a quarter of a cell vanish, 26 % of its edges; a larger height or "
            "scale keeps them");
  EXPECT_EQ(warnings("solid", 15.3, 0.3), Lines{}) << "a layer of samples lies in it: 16 of 64";
  const Lines wall = warnings("inert", 15.3, 0.3);
  ASSERT_EQ(wall.size(), 1u) << "an inert cell needs half of its samples";
  EXPECT_NE(wall[0].find("parts thinner than half a cell vanish"), std::string::npos) << wall[0];
  EXPECT_EQ(warnings("inert", 15.1, 0.8), Lines{});
}

}  // namespace
}  // namespace voxmelt::scene
