// Volumes of voxelised shapes agree with the analytic ones, within the tolerance of 64 samples per cell.
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "kernel/scene/shape/coverage.h"
#include "kernel/scene/shape/polygon.h"
#include "kernel/scene/shape/shape.h"
#include "tests/kernel/scene/scene_text.h"

namespace voxmelt::scene {
namespace {

constexpr double kPi = std::numbers::pi;

struct Case {
  const char* name;
  const char* shape;  // keys of [[solid]]
  double volume;
  double tolerance;  // share of the volume
};

class Shapes : public testing::TestWithParam<Case> {};

TEST_P(Shapes, VolumeIsAnalytic) {
  const SceneFolder folder;
  const Scene scene =
      folder.load_text(std::string("[grid]\nsize = [48, 48, 48]\n[[solid]]\n") + GetParam().shape + "\n");
  EXPECT_NEAR(solid_mass(scene.initial), GetParam().volume, GetParam().tolerance * GetParam().volume);
  EXPECT_TRUE(scene.warnings.empty());
}

const Case kCases[] = {
    {"sphere", "shape='sphere'\nradius=15\nat=[24,24,24]", 4.0 / 3 * kPi * 15 * 15 * 15, 0.002},
    {"box", "shape='box'\nsize=[10,20,30]\nat=[24,24,24]", 6000, 0},
    {"box_of_fractions", "shape='box'\nsize=[10.5,20.5,30.5]\nat=[24.25,24.25,24.25]", 10.5 * 20.5 * 30.5, 0},
    {"turned_box", "shape='box'\nsize=[10,20,30]\nat=[24,24,24]\nrotate=[90,0,90]", 6000, 0},
    {"oblique_box", "shape='box'\nsize=[10,20,30]\nat=[24,24,24]\nrotate=[31,17,53]", 6000, 0.003},
    {"cylinder", "shape='cylinder'\nradius=10\nheight=20\nat=[24,10,24]", kPi * 100 * 20, 0.003},
    {"cone", "shape='cone'\nradius=15\nheight=30\nat=[24,5,24]", kPi * 225 * 10, 0.004},
    {"frustum", "shape='cone'\nradius=15\nradius_top=5\nheight=30\nat=[24,5,24]", kPi * 10 * (225 + 75 + 25),
     0.003},
    {"ellipsoid", "shape='ellipsoid'\nradii=[20,10,15]\nat=[24,24,24]", 4.0 / 3 * kPi * 3000, 0.003},
    {"capsule", "shape='capsule'\nfrom=[14,24,24]\nto=[34,24,24]\nradius=8", kPi * 64 * (20 + 4.0 / 3 * 8),
     0.003},
    {"tube", "shape='tube'\npath=[[10,24,24,5],[38,24,24,5]]", kPi * 25 * (28 + 4.0 / 3 * 5), 0.006},
    {"tube_of_one_place", "shape='tube'\npath=[[24,24,24,4],[24,24,24,10]]", 4.0 / 3 * kPi * 1000, 0.003},
    {"torus", "shape='torus'\nradius=14\ntube=5\nat=[24,24,24]", 2 * kPi* kPi * 14 * 25, 0.003},
    {"revolve", "shape='revolve'\nprofile=[[5,0],[15,0],[15,20],[5,20]]\nat=[24,10,24]", kPi * 200 * 20,
     0.003},
    {"extrude", "shape='extrude'\noutline=[[-10,-10],[10,-10],[-10,10]]\ndepth=16\nat=[24,24,24]", 200 * 16,
     0.01},
    {"scaled", "shape='sphere'\nradius=5\nscale=[2,3,4]\nat=[24,24,24]", 4.0 / 3 * kPi * 125 * 24, 0.003},
    {"mirrored", "shape='box'\nsize=[4,4,4]\nat=[24,24,24]\nmirror='x'", 64, 0},
    {"csg_difference",
     "shape='csg'\nop='difference'\nparts=[{shape='box',size=[20,20,20]},{shape='sphere',radius=8}]\nat=[24,"
     "24,24]",
     8000 - 4.0 / 3 * kPi * 512, 0.002},
    {"csg_intersection",
     "shape='csg'\nop='intersection'\nparts=[{shape='box',size=[20,20,20]},{shape='box',size=[20,20,20],at=["
     "10,0,0]}]\nat=[24,24,24]",
     4000, 0},
    {"csg_union",
     "shape='csg'\nop='union'\nparts=[{shape='box',size=[10,10,10]},{shape='box',size=[10,10,10],at=[5,0,0]}]"
     "\nat=[24,24,24]",
     1500, 0},
    {"cut",
     "shape='box'\nsize=[20,20,20]\nat=[24,24,24]\n[[solid]]\nshape='sphere'\nradius=8\nat=[24,24,24]\ncut="
     "true",
     8000 - 4.0 / 3 * kPi * 512, 0.002},
};

INSTANTIATE_TEST_SUITE_P(All, Shapes, testing::ValuesIn(kCases),
                         [](const auto& tested) { return std::string(tested.param.name); });

// Skipping blocks must not change a single sample. So the same shape is sampled place by place.
TEST(Coverage, SkippedBlocksAreThoseThatSamplesWouldFill) {
  std::vector<ShapePtr> parts;
  parts.push_back(
      make_extrude(Polygon(smooth_outline({{-9, -8}, {0, -10}, {9, -6}, {4, 0}, {8, 9}, {-7, 8}, {-3, 0}})),
                   {8, 2, 2, 5}));
  parts.push_back(make_placed(make_ellipsoid({3, 9, 4}), {{1, 2, 3}, Rotation({20, 30, 40}), {1, 1, 1.5}}));
  parts.push_back(make_tube({{{-3, -3, 0}, 3}, {{4, 6, 2}, 1.5}, {{5, 6, 9}, 2}}));
  const ShapePtr shape = make_placed(make_csg(Operation::difference, std::move(parts)),
                                     {{16, 16, 16}, Rotation({10, 20, 30}), {1, 1, 1}});
  const state::Grid grid{32, 31, 33};
  const Coverage coverage = cover(*shape, grid);
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x) {
        int covered = 0;
        for (int i = 0; i < 64; ++i) {
          const int sx = i % 4, sy = i / 4 % 4, sz = i / 16;
          const Point sample{x + (sx + 0.5) / 4, y + (sy + 0.5) / 4, z + (sz + 0.5) / 4};
          covered += shape->distance(sample) <= 0 ? 1 : 0;
        }
        const Window& window = coverage.window;
        const bool within = x >= window.x && y >= window.y && z >= window.z && x < window.x + window.size.x &&
                            y < window.y + window.size.y && z < window.z + window.size.z;
        ASSERT_EQ(within ? coverage.samples[window.index(x, y, z)] : 0, covered) << x << ' ' << y << ' ' << z;
      }
}

TEST(Voxels, InertWinsOverSolidAndSolidOverLiquid) {
  const SceneFolder folder;
  const Scene scene = folder.load_text(R"(
[grid]
size = [4, 3, 1]
[heat]
gamma = 0.1
[[liquid]]
shape = "box"
size = [4, 3, 1]
at = [2, 1.5, 0.5]
amount = 0.5
energy = 0.25
temperature = 1.0
[[solid]]
shape = "box"
size = [2, 3, 1]
at = [1, 1.5, 0.5]
temperature = 0.5
[[inert]]
shape = "floor"
)");
  const state::Volume& volume = scene.initial;
  for (int x = 0; x < 4; ++x) {
    EXPECT_TRUE(volume.inert.test(x, 0, 0));
    EXPECT_EQ(volume.amount[volume.at(x, 0, 0)], 2048);
    EXPECT_EQ(volume.heat[volume.at(x, 0, 0)], 0);
    const state::Slot above = volume.at(x, 1, 0);
    EXPECT_EQ(volume.solid.test(x, 1, 0), x < 2);
    EXPECT_EQ(volume.liquid.test(x, 1, 0), x >= 2);
    EXPECT_EQ(volume.amount[above], x < 2 ? 4096 : 2048);
    EXPECT_EQ(volume.energy[above], x < 2 ? 0 : 1024);
    EXPECT_EQ(volume.heat[above], x < 2 ? 32768 : 65535);
  }
}

// A wall of temperature T holds the heat at which matter has that temperature. This is T up to the melting
// point, 0.5 (32768), and above it T and the latent heat, 0.25 (16384). 0 is a wall of the least heat.
// Without the key there is no wall.
TEST(Voxels, AnInertShapeWithATemperatureIsAWall) {
  const SceneFolder folder;
  const Scene scene = folder.load_text(R"(
[grid]
size = [5, 4, 1]
[material]
latent_heat = 0.25
[heat]
[[solid]]
shape = "box"
size = [1, 1, 1]
at = [0.5, 3.5, 0.5]
[[inert]]
shape = "floor"
temperature = 0.5
[[inert]]
shape = "box"
size = [1, 2, 1]
at = [0.5, 1, 0.5]
temperature = 0.75
[[inert]]
shape = "box"
size = [1, 1, 1]
at = [1.5, 1.5, 0.5]
temperature = 0
[[inert]]
shape = "box"
size = [2, 3, 1]
at = [3, 1.5, 0.5]
)");
  const auto heat = [&](int x, int y) { return scene.initial.heat[scene.initial.at(x, y, 0)]; };
  EXPECT_TRUE(scene.parameters.heat.walls);
  EXPECT_EQ(heat(0, 0), 49151 + 16384) << "a shape keeps its temperature inside the ground";
  EXPECT_EQ(heat(0, 1), 49151 + 16384);
  EXPECT_EQ(heat(1, 0), 32768);
  EXPECT_EQ(heat(1, 1), 1);
  EXPECT_EQ(heat(2, 0), 32768) << "a shape without one leaves the ground's";
  EXPECT_EQ(heat(2, 1), 0);
  EXPECT_EQ(heat(4, 1), 0);
  EXPECT_EQ(scene.features, (std::vector<std::string>{"heat", "walls", "latent_heat", "diagonal"}));
}

// Without [heat] nothing conducts. The state holds no heat then, and no feature is asked for.
TEST(Voxels, NoWallWithoutHeat) {
  const SceneFolder folder;
  const Scene scene = folder.load_text(
      "[grid]\nsize = [2, 2, 1]\n[[liquid]]\nshape = \"sphere\"\nradius = 1\n"
      "[[inert]]\nshape = \"floor\"\ntemperature = 0.9\n");
  EXPECT_FALSE(scene.parameters.heat.walls);
  EXPECT_EQ(scene.initial.heat[scene.initial.at(0, 0, 0)], 0);
}

TEST(Voxels, ThinCoverageIsDropped) {
  const SceneFolder folder;
  const auto solid = [&](const char* thickness) {
    return folder
        .load_text(std::string("[grid]\nsize=[4,4,4]\n[[solid]]\nshape='box'\nsize=[4,") + thickness +
                   ",1]\nat=[2,2.125,2.5]")
        .initial;
  };
  const state::Volume layer = solid("0.25");  // one of four layers of samples is inside
  EXPECT_EQ(layer.solid.count(), 4);
  EXPECT_EQ(layer.amount[layer.at(1, 2, 2)], 1024);
  const SceneFolder other;
  const Scene one =
      other.load_text("[grid]\nsize=[2,2,2]\n[[solid]]\nshape='sphere'\nradius=0.1\nat=[0.625,0.625,0.625]");
  EXPECT_EQ(one.initial.solid.count(), 0);  // only one sample of 64 is inside
}

}  // namespace
}  // namespace voxmelt::scene
