// The bed offsets of inert shapes say where the surface lies inside a cell. Boxes are counted by hand, from
// sample points at 1/8, 3/8, 5/8 and 7/8 of a cell; slopes are compared with the height of the surface.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "tests/kernel/scene/scene_text.h"

namespace voxmelt::scene {
namespace {

constexpr int kFlat = 2048, kQuarter = 1024;

class Beds : public testing::Test {
 protected:
  // Loads a grid of 24 x 16 x 24 cells with some inert shapes and a drop, which a scene must have.
  void load(const std::string& inert, const std::string& more = "") {
    scene_ = folder_.load_text("liquid=[{shape='sphere',radius=1,at=[22,14,22]}]\ninert=[" + inert +
                               "]\n[grid]\nsize=[24,16,24]\n" + more);
  }
  const state::Volume& volume() const { return scene_.initial; }
  int offset(int x, int y, int z) const { return volume().amount[volume().at(x, y, z)]; }
  bool inert(int x, int y, int z) const { return volume().inert.test(x, y, z); }

  // Returns the lowest y from which on the column holds no inert cell.
  int end(int x, int z) const {
    int y = volume().grid.y;
    while (y > 0 && !inert(x, y - 1, z)) --y;
    return y;
  }

  // Checks all columns that hold anything inert.
  void expect_tops(int y, int offset_of_all) const {
    int columns = 0;
    for (int z = 0; z < 24; ++z)
      for (int x = 0; x < 24; ++x) {
        const int top = end(x, z) - 1;
        if (top < 0) continue;
        ++columns;
        EXPECT_EQ(top, y) << x << ' ' << z;
        EXPECT_EQ(offset(x, top, z), offset_of_all) << x << ' ' << z;
        for (int under = 0; under < top; ++under)
          EXPECT_EQ(offset(x, under, z), inert(x, under, z) ? kFlat : 0) << x << ' ' << under << ' ' << z;
      }
    EXPECT_GT(columns, 0);
  }

  // Returns how far the beds lie from a surface on the mean, in cells, over all columns with a height above
  // 0.
  double mean_error(const std::function<double(double, double)>& height) const {
    double sum = 0;
    int columns = 0;
    for (int z = 0; z < 24; ++z)
      for (int x = 0; x < 24; ++x) {
        const double exact = height(x + 0.5, z + 0.5);
        const int top = end(x, z);
        if (exact <= 0 || top == 0) continue;
        sum += std::abs(top + (offset(x, top - 1, z) - kFlat) / 4096.0 - exact);
        ++columns;
      }
    EXPECT_GT(columns, 40);
    return sum / std::max(columns, 1);
  }

 private:
  SceneFolder folder_;
  Scene scene_;
};

TEST_F(Beds, AnAlignedBoxIsFlat) {
  load("{shape='box',size=[8,6,8],at=[12,6,12]}");
  expect_tops(8, kFlat);
}

// 8.7 covers three of the four layers of samples of cell 8, and 9.3 one of those of cell 9, which stays air.
TEST_F(Beds, ABoxEndsInsideACell) {
  load("{shape='box',size=[8,5.7,8],at=[12,5.85,12]}");
  expect_tops(8, kFlat - kQuarter);
  load("{shape='box',size=[8,6.3,8],at=[12,6.15,12]}");
  expect_tops(8, kFlat + kQuarter);
}

// Here the sides lie inside cells: the outermost ones are covered by half or three quarters of their width.
TEST_F(Beds, ARimIsAsHighAsTheMiddle) {
  load("{shape='box',size=[8,6,8],at=[12.25,6,12.5]}");
  expect_tops(8, kFlat);
  load("{shape='box',size=[8,6.25,8],at=[12.25,6.125,12]}");
  expect_tops(8, kFlat + kQuarter);
}

// The border and the ground count as covered where a shape stands on them.
TEST_F(Beds, AShapeThatIsOneOrTwoCellsHigh) {
  load("{shape='box',size=[8,0.75,8],at=[12,0.375,12]}");
  expect_tops(0, kFlat - kQuarter);
  load("{shape='box',size=[8,1.75,8],at=[12.25,0.875,12]}");  // with a rim
  expect_tops(1, kFlat - kQuarter);
  load("{shape='floor',thickness=2},{shape='box',size=[24,0.75,24],at=[12,2.375,12]}");
  expect_tops(2, kFlat - kQuarter);
  load("{shape='floor',thickness=2},{shape='box',size=[24,1.75,24],at=[12,2.875,12]}");
  expect_tops(3, kFlat - kQuarter);
}

// A plate may be cut from above or from beneath: a cell that is covered by three quarters does not say. Where
// the cell below is covered whole, it does.
TEST_F(Beds, AThinPlateIsFlat) {
  load("{shape='box',size=[8,0.75,8],at=[12,8.375,12]}");
  expect_tops(8, kFlat);
  load("{shape='box',size=[8,1.25,8],at=[12,8.125,12]}");  // half of cell 7, three quarters of cell 8
  expect_tops(8, kFlat);
  load("{shape='box',size=[8,1.75,8],at=[12,7.875,12]}");
  expect_tops(8, kFlat - kQuarter);
}

// An offset goes from half a cell below the upper face to just under half a cell above it. At a rim of half a
// cell's width, a top at 8.75 lies three quarters above the last cell that is covered by half.
TEST_F(Beds, OffsetsHaveEnds) {
  load("{shape='box',size=[8,5.5,8],at=[12,5.75,12]}");
  expect_tops(8, 0);
  load("{shape='box',size=[8,5.75,8],at=[12.5,5.875,12]}");
  EXPECT_EQ(end(8, 12), 8);
  EXPECT_EQ(offset(8, 7, 12), 4095);
  EXPECT_EQ(end(9, 12), 9);
  EXPECT_EQ(offset(9, 8, 12), kFlat - kQuarter);
}

// No cell without an amount has heat, so an isothermal wall has an offset of at least 1.
TEST_F(Beds, AWallKeepsItsHeat) {
  load("{shape='box',size=[8,5.5,8],at=[12,5.75,12],temperature=0.5}", "[heat]\ngamma=0.1\n");
  expect_tops(8, 1);
  EXPECT_EQ(volume().heat[volume().at(12, 8, 12)], 32768);
}

// The upper side lies 5 above the middle of the box, across it. It falls by 20 degrees along x, and then by
// 15 along z as well. Each offset is a mean of 64 samples. Whole cells alone would be a quarter off.
TEST_F(Beds, ASlopeIsWhereItsPlaneIs) {
  const double degree = std::acos(-1) / 180;
  load("{shape='box',size=[40,10,40],at=[12,5,12],rotate=[0,0,-20]}");
  EXPECT_LT(mean_error([&](double x, double) {
              return 5 + 5 / std::cos(20 * degree) - std::tan(20 * degree) * (x - 12);
            }),
            0.03);
  load("{shape='box',size=[40,10,40],at=[12,2,12],rotate=[15,0,-20]}");
  const double along_x = std::sin(20 * degree) * std::cos(15 * degree), along_z = std::sin(15 * degree),
               upward = std::cos(20 * degree) * std::cos(15 * degree);  // the normal
  EXPECT_LT(mean_error([&](double x, double z) {
              return 2 + (5 - along_x * (x - 12) - along_z * (z - 12)) / upward;
            }),
            0.03);
}

// Down to 45 degrees; steeper ones pass more than half a cell per column.
TEST_F(Beds, ACylinderAndABallAreRound) {
  const auto gentle = [](double radius, double along) {
    return along * along > radius * radius / 2 ? 0 : std::sqrt(radius * radius - along * along);
  };
  load("{shape='cylinder',radius=10.3,height=26,at=[11.7,2.4,-1],rotate=[90,0,0]}");
  EXPECT_LT(mean_error([&](double x, double) {
              const double high = gentle(10.3, x - 11.7);
              return high > 0 ? 2.4 + high : 0;
            }),
            0.05);
  load("{shape='sphere',radius=10.3,at=[11.7,2.4,12.1]}");
  EXPECT_LT(mean_error([&](double x, double z) {
              const double high = gentle(10.3, std::hypot(x - 11.7, z - 12.1));
              return high > 0 ? 2.4 + high : 0;
            }),
            0.05);
}

}  // namespace
}  // namespace voxmelt::scene
