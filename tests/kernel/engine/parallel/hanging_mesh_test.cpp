// A mesh whose parts hang: a chandelier of boxes on a hook, melted by a lamp above it. Nothing hangs in the
// air.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/kernel/engine/parallel/hanging.h"
#include "tests/kernel/scene/scene_text.h"

namespace voxmelt {
namespace {

using Corner = std::array<int, 3>;

// Collects boxes as an OBJ file, in cells. Boxes that overlap are one body.
class Boxes {
 public:
  void add(const Corner& low, const Corner& high) {
    for (int n = 0; n < 8; ++n) {
      text_ += "v";
      for (int axis = 0; axis < 3; ++axis)
        text_ += " " + std::to_string((n >> axis & 1) != 0 ? high[axis] : low[axis]);
      text_ += "\n";
    }
    for (const auto& face : std::array<std::array<int, 4>, 6>{
             {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}}) {
      text_ += "f";
      for (const int corner : face) text_ += " " + std::to_string(first_ + corner);
      text_ += "\n";
    }
    first_ += 8;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  int first_ = 1;
};

// A stem, a cross of arms, and on each side of each arm's end a candle that stands and a drop that hangs by a
// thread. Its origin is in the middle, at the lowest drops.
std::string chandelier() {
  Boxes boxes;
  boxes.add({-2, 8, -2}, {2, 30, 2});
  boxes.add({-16, 16, -2}, {16, 19, 2});
  boxes.add({-2, 16, -16}, {2, 19, 16});
  for (const auto& [x, z] : std::array<std::array<int, 2>, 8>{
           {{-14, 0}, {14, 0}, {0, -14}, {0, 14}, {-7, 0}, {7, 0}, {0, -7}, {0, 7}}}) {
    boxes.add({x - 1, 18, z - 1}, {x + 1, 24, z + 1});
    boxes.add({x, 6, z}, {x + 1, 17, z + 1});
    boxes.add({x - 1, 0, z - 1}, {x + 2, 7, z + 2});
  }
  return boxes.text();
}

constexpr const char* kScene = R"(title = "chandelier"
[grid]
size = [44, 48, 44]
[pieces]
in_liquid = 4
[[solid]]
shape = "mesh"
file = "chandelier.obj"
scale = 1
at = [22, 10, 22]
[[inert]]
shape = "box"
size = [6, 4, 6]
at = [22, 41, 22]
[[inert]]
shape = "floor"
[material]
melting_point = 0.5
[heat]
gamma = 0.1
[[heat_source]]
at = [22, 70, 26]
power = 30
[flow]
)";

TEST(Hanging, NoPartOfAForeignMesh) {
  for (const char* law :
       {"law = \"paper\"\n", "law = \"viscous\"\nviscous = { kappa = 0.01, substeps_max = 4 }\n"}) {
    SCOPED_TRACE(law);
    const scene::SceneFolder folder;
    folder.write("chandelier.obj", chandelier());
    const scene::Scene scene = folder.load_text(std::string(kScene) + law);
    ASSERT_EQ(scene.warnings.size(), 2u);  // both say what the mesh is: 27 shells, which overlap
    EXPECT_EQ(scene.warnings[0], "chandelier.obj: 27 shells");
    ASSERT_EQ(hanging::loose_pieces(scene.initial).size(), 0u) << "it hangs on its hook";
    ASSERT_GT(scene.initial.solid.count(), 1000);
    EXPECT_GE(hanging::watch(scene, scene.parameters, 400), 40) << "hardly anything fell";
  }
}

}  // namespace
}  // namespace voxmelt
