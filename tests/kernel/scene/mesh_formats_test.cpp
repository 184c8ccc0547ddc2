// Meshes in the formats other than OBJ. Their parts, nodes and places in the grid.
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "tests/kernel/scene/mesh_files.h"
#include "tests/kernel/scene/scene_text.h"

namespace voxmelt::scene {
namespace {

class MeshFormats : public testing::Test {
 protected:
  Scene load_mesh(const std::string& file, const std::string& keys) const {
    return folder_.load_text(scene_of(file, keys));
  }
  std::string error_of_mesh(const std::string& file, const std::string& bytes,
                            const std::string& keys = kStand) const {
    folder_.write(file, bytes);
    return folder_.error_of(scene_of(file, keys));
  }
  static std::string scene_of(const std::string& file, const std::string& keys) {
    return fmt::format("[grid]\nsize = [16, 20, 24]\n[[solid]]\nshape = \"mesh\"\nfile = \"{}\"\n{}", file,
                       keys);
  }

  // Tells if solid cells are those of the box, and all of them are full.
  static testing::AssertionResult is_box(const Scene& scene, std::array<int, 3> low,
                                         std::array<int, 3> high) {
    for (int z = 0; z < 24; ++z)
      for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 16; ++x) {
          const bool within =
              x >= low[0] && x < high[0] && y >= low[1] && y < high[1] && z >= low[2] && z < high[2];
          const int amount = scene.initial.amount[scene.initial.at(x, y, z)];
          if (amount != (within ? 4096 : 0))
            return testing::AssertionFailure()
                   << "amount " << amount << " at " << x << ", " << y << ", " << z;
        }
    return testing::AssertionSuccess();
  }

  static constexpr const char* kStand = "scale = 1\nat = [8, 2, 8]\n";
  SceneFolder folder_;
};

// Two boxes with a gap. Both are of whole cells where the tests put them.
MeshText two_boxes() {
  MeshText mesh;
  mesh.box({0, 0, 0}, {2, 4, 6}).box({4, 0, 0}, {4, 8, 6});
  return mesh;
}

TEST_F(MeshFormats, PartsOfAnObj) {
  MeshText mesh = two_boxes();
  std::string text = mesh.text();
  std::size_t at = text.find("f ");
  text.insert(at, "o low one\n");
  for (int i = 0; i < 7; ++i) at = text.find("f ", at + 2);
  text.insert(at, "g tall\n");
  folder_.write("m.obj", text);
  EXPECT_TRUE(
      is_box(load_mesh("m.obj", "part = \"low one\"\nscale = 1\nat = [8, 2, 8]\n"), {7, 2, 5}, {9, 6, 11}));
  const Scene tall = load_mesh("m.obj", "part = \"tall\"\nscale = 1\nat = [8, 2, 8]\n");
  EXPECT_TRUE(is_box(tall, {6, 2, 5}, {10, 10, 11}));
  EXPECT_TRUE(tall.warnings.empty()) << "vertices of the other part are no vertices without a face";
  EXPECT_EQ(folder_.error_of(scene_of("m.obj", "part = \"tal\"\nscale = 1\n")),
            "scene.toml:6:8: error: m.obj: it has no part 'tal'; did you mean 'tall'?");
  EXPECT_EQ(folder_.error_of(scene_of("m.obj", "part = \"whatever\"\nscale = 1\n")),
            "scene.toml:6:8: error: m.obj: it has no part 'whatever'; its parts are 'low one', 'tall'");
  folder_.write("m.stl", stl_text(as_triangles(mesh)));
  EXPECT_NO_THROW(load_mesh("m.stl", "part = \"a body\"\nscale = 1\nat = [8, 2, 8]\n"));
  folder_.write("m.ply", ply_text(mesh));
  EXPECT_EQ(folder_.error_of(scene_of("m.ply", "part = \"x\"\nscale = 1\n")),
            "scene.toml:6:8: error: m.ply: it has no part 'x'; no part of it has a name");
}

TEST_F(MeshFormats, ZIsUpAsInModelsForPrinting) {
  MeshText mesh;
  mesh.box({0, 0, 0}, {2, 4, 6});  // 6 high, and 4 deep, with z up
  mesh.box({0, 4, 0}, {2, 2, 2});  // behind it, seen from -y
  folder_.write("m.stl", stl_bytes(as_triangles(mesh)));
  const Scene scene = load_mesh("m.stl", "up = \"z\"\nscale = 1\nat = [8, 2, 8]\n");
  const auto is_solid = [&](int x, int y, int z) { return scene.initial.solid.test(x, y, z); };
  EXPECT_TRUE(is_solid(8, 7, 10)) << "the tall box stands in front, at +z";
  EXPECT_FALSE(is_solid(8, 8, 10));
  EXPECT_TRUE(is_solid(8, 3, 5)) << "the low one behind it";
  EXPECT_FALSE(is_solid(8, 4, 5));
  EXPECT_FALSE(is_solid(8, 2, 11));
}

TEST_F(MeshFormats, UnitsOfLength) {
  MeshText mesh;
  mesh.box({0, 0, 0}, {20, 40, 60});
  folder_.write("m.ply", ply_bytes(mesh, true));
  EXPECT_TRUE(
      is_box(load_mesh("m.ply", "unit = \"mm\"\nscale = 100\nat = [8, 2, 8]\n"), {7, 2, 5}, {9, 6, 11}));
  EXPECT_TRUE(
      is_box(load_mesh("m.ply", "unit = \"cm\"\nscale = 10\nat = [8, 2, 8]\n"), {7, 2, 5}, {9, 6, 11}));
  EXPECT_EQ(folder_.error_of(scene_of("m.ply", "unit = \"mm\"\nheight = 4\n")),
            "scene.toml:6:8: error: solid.0.unit needs scale, which counts cells per metre then");
}

// The box is 2 x 4 x 6. The grid has room for 12 x 15 x 20 of its 16 x 20 x 24 cells. So it grows by 20 / 6,
// and by 3 with a margin of 3.
TEST_F(MeshFormats, FitsTheGrid) {
  MeshText mesh;
  mesh.box({100, 100, 100}, {2, 4, 6});
  folder_.write("m.obj", mesh.text());
  EXPECT_TRUE(is_box(load_mesh("m.obj", "fit = { margin = 3, floor = 2 }\n"), {5, 2, 3}, {11, 14, 21}));
  EXPECT_TRUE(is_box(load_mesh("m.obj", "fit = { margin = 6 }\n"), {6, 0, 6}, {10, 8, 18}));
  MeshText tall;
  tall.box({0, 0, 0}, {2, 15, 2});
  folder_.write("m.obj", tall.text());
  EXPECT_TRUE(is_box(load_mesh("m.obj", "fit = { floor = 3 }\n"), {7, 3, 11}, {9, 18, 13}))
      << "a margin of 2";
  EXPECT_EQ(folder_.error_of(scene_of("m.obj", "fit = { margin = 8 }\n")),
            "scene.toml:6:7: error: solid.0.fit: a margin of 8 and a floor of 0 leave no room");
  EXPECT_EQ(folder_.error_of(scene_of("m.obj", "fit = {}\nheight = 4\n")),
            "scene.toml:7:10: error: solid.0.height and fit exclude each other");
  EXPECT_EQ(folder_.error_of(scene_of("m.obj", "fit = { margins = 2 }\n")),
            "scene.toml:6:9: error: unknown key solid.0.fit.margins; did you mean solid.0.fit.margin?");
  EXPECT_NE(folder_.error_of(scene_of("m.obj", "fit = { floor = 21 }\n")), "");
}

// glTF puts meshes by nodes. The box of side 2 about the origin is stretched to 2 x 4 x 6 and turned about y,
// so that it is 6 x 4 x 2. Its parent moves it and mirrors x. A second node has the same mesh.
TEST_F(MeshFormats, NodesOfGltf) {
  MeshText mesh;
  mesh.box({-1, -1, -1}, {2, 2, 2});
  GltfText text = gltf_text(as_triangles(mesh), "");
  const std::string nodes =
      R"("nodes":[{"children":[1,2],"translation":[0,0,1],"scale":[-1,1,1]},)"
      R"({"mesh":0,"name":"beam","rotation":[0,0.7071067811865476,0,0.7071067811865476],"scale":[1,2,3]},)"
      R"({"mesh":0,"name":"cube","matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 6,5,0,1]}])";
  const std::size_t at = text.json.find("\"nodes\":[{");
  text.json.replace(at, text.json.find(']', at) + 1 - at, nodes);
  folder_.write("m.glb", glb_bytes(text));
  const Scene beam = load_mesh("m.glb", "part = \"beam\"\nscale = 1\nat = [8, 2, 8]\n");
  EXPECT_TRUE(is_box(beam, {5, 2, 7}, {11, 6, 9}));
  EXPECT_TRUE(beam.warnings.empty()) << "what is mirrored is not inside out";
  // Together they are 10 x 8 x 2: the beam at -3..3 and -2..2, the cube at -7..-5 and 4..6.
  const Scene both = load_mesh("m.glb", "scale = 1\nat = [8, 2, 8]\n");
  const auto is_solid = [&](int x, int y) { return both.initial.solid.test(x, y, 7); };
  EXPECT_TRUE(is_solid(3, 8) && is_solid(4, 9) && is_solid(7, 2) && is_solid(12, 5));
  EXPECT_FALSE(is_solid(5, 8) || is_solid(3, 7) || is_solid(6, 2) || is_solid(13, 2) || is_solid(12, 6));
  EXPECT_EQ(solid_mass(both.initial), 6 * 4 * 2 + 8);
}

// A strip and a fan of a tetrahedron's corners, and whole coordinates of one byte.
TEST_F(MeshFormats, StripsFansAndShortNumbersOfGltf) {
  std::string bytes("\0\0\0\0\x8\0\0\0\0\0\x8\0\0\x8\0\0", 16);  // (0,0,0) (8,0,0) (0,0,8) (0,8,0)
  const auto text = [&](const std::string& primitives, const std::string& indices) {
    GltfText result;
    result.bytes = bytes + indices;
    result.json = fmt::format(
        R"({{"asset":{{"version":"2.0"}},"extensionsRequired":["KHR_mesh_quantization"],"nodes":[{{"mesh":0}}],)"
        R"("meshes":[{{"primitives":[{0}]}}],"accessors":[{{"bufferView":0,"componentType":5121,"count":4,"type":"VEC3"}},)"
        R"({{"bufferView":1,"componentType":5121,"count":{1},"type":"SCALAR"}}],)"
        R"("bufferViews":[{{"buffer":0,"byteLength":16,"byteStride":4}},{{"buffer":0,"byteOffset":16,"byteLength":{1}}}],)"
        R"("buffers":[{{"byteLength":{2}}}]}})",
        primitives, indices.size(), result.bytes.size());
    return glb_bytes(result);
  };
  const auto primitive = [](int mode) {
    return fmt::format(R"({{"attributes":{{"POSITION":0}},"indices":1,"mode":{}}})", mode);
  };
  MeshText mesh;
  mesh.vertices = {{0, 0, 0}, {8, 0, 0}, {0, 0, 8}, {0, 8, 0}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  folder_.write("m.obj", mesh.text());
  const Scene expected = load_mesh("m.obj", kStand);
  EXPECT_TRUE(expected.warnings.empty());
  for (const auto& [name, mode, indices] :
       {std::tuple{"triangles", 4, std::string("\0\1\2\0\2\3\0\3\1\1\3\2", 12)},
        std::tuple{"strip", 5, std::string("\0\1\2\3\0\1", 6)}}) {
    folder_.write("m.glb", text(primitive(mode), indices));
    const Scene scene = load_mesh("m.glb", kStand);
    EXPECT_EQ(scene.initial_digest, expected.initial_digest) << name;
    EXPECT_TRUE(scene.warnings.empty()) << name << ": " << scene.warnings.front();
  }
  folder_.write("m.glb", text(primitive(6), std::string("\0\1\2\3\1", 5)));  // all but the slope
  EXPECT_EQ(
      load_mesh("m.glb", kStand).warnings,
      std::vector<std::string>{"m.glb: 3 open edges: the mean over six directions says what is inside"});
  folder_.write("m.glb",
                text(primitive(1) + "," + primitive(4), std::string("\0\1\2\0\2\3\0\3\1\1\3\2", 12)));
  EXPECT_EQ(load_mesh("m.glb", kStand).initial_digest, expected.initial_digest) << "lines are passed over";
}

TEST_F(MeshFormats, BuffersOfGltf) {
  const MeshText mesh = as_triangles(two_boxes());
  folder_.write("m.glb", glb_bytes(gltf_text(mesh, "")));
  const Scene expected = load_mesh("m.glb", kStand);
  const GltfText text = gltf_text(mesh, "the%20numbers.bin");
  folder_.write("m.gltf", text.json);
  folder_.write("the numbers.bin", text.bytes);
  const Scene scene = load_mesh("m.gltf", kStand);
  EXPECT_EQ(scene.initial_digest, expected.initial_digest);
  std::vector<std::string> names;
  for (const auto& file : scene.files) names.push_back(file.filename().string());
  EXPECT_EQ(names, (std::vector<std::string>{"scene.toml", "m.gltf", "the numbers.bin"}));
  // The Base64 of "Man" is TWFu, as RFC 4648 explains. Here a triangle is coded by hand: 12 bytes of indices,
  // 0 0 0 0, 1 0 0 0, 2 0 0 0, are AAAAAAEAAAACAAAA, and a coordinate of 1.0 is 0000803f.
  const std::string flat = gltf_text(MeshText{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, "").json;
  std::string coded = flat;
  coded.insert(
      coded.rfind("}]}"),
      R"(,"uri":"data:application/octet-stream;base64,AAAAAAEAAAACAAAAAAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAAAACAPwAAAAAAAAAA")");
  folder_.write("m.gltf", coded);
  const std::vector<std::string> warnings = load_mesh("m.gltf", "height = 8\nat = [8, 2, 8]\n").warnings;
  EXPECT_EQ(std::count(warnings.begin(), warnings.end(),
                       "m.gltf: 3 open edges: the mean over six directions says what is inside"),
            1);
  folder_.write("m.gltf", gltf_text(mesh, "gone.bin").json);
  EXPECT_NE(folder_.error_of(scene_of("m.gltf", kStand)).find("buffers.0.uri: error: cannot read gone.bin"),
            std::string::npos)
      << folder_.error_of(scene_of("m.gltf", kStand));
}

TEST_F(MeshFormats, AnEndingThatIsNotRead) {
  EXPECT_EQ(
      error_of_mesh("m.fbx", "x"),
      "scene.toml:5:8: error: m.fbx: meshes are read from .obj, .stl, .ply, .glb, .gltf, not from .fbx");
  folder_.write("M.STL", stl_bytes(as_triangles(two_boxes())));
  EXPECT_NO_THROW(load_mesh("M.STL", kStand));
}

}  // namespace
}  // namespace voxmelt::scene
