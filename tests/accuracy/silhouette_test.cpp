// Geometry knows the solid angles of these cells.
#include "accuracy/silhouette.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "accuracy/cells.h"

namespace voxmelt::accuracy {
namespace {

// Returns the solid angle of a rectangle of half sides a and b, from the distance d in front of its middle.
double of_rectangle(double a, double b, double d) {
  return 4 * std::asin(a * b / std::sqrt((a * a + d * d) * (b * b + d * d)));
}

// A block has 8 x 4 x 8 cells. Only its nearest face counts, by its own distance.
TEST(Silhouette, BlockFromTheFront) {
  state::Volume v(state::Grid{16, 16, 16});
  for (int z = 4; z < 12; ++z)
    for (int y = 6; y < 10; ++y)
      for (int x = 4; x < 12; ++x) put_solid(v, x, y, z);
  EXPECT_NEAR(solid_angle(v, {8, 8, 112}) / of_rectangle(4, 2, 100), 1, 0.03);
  EXPECT_NEAR(solid_angle(v, {8, 110, 8}) / of_rectangle(4, 4, 100), 1, 0.03);
  EXPECT_EQ(solid_angle(state::Volume(state::Grid{16, 16, 16}), {8, 8, 112}), 0);
}

// From far away a cube of side s seen along (1, 1, 1) is a hexagon of area sqrt(3) s^2. Along (1, 1, 0) it is
// a rectangle of sqrt(2) s^2. Cells behind others add nothing.
TEST(Silhouette, CubeFromItsCornerAndItsEdge) {
  state::Volume v(state::Grid{20, 20, 20});
  for_each_cell({18, 18, 18}, [&](int x, int y, int z) {
    if (x >= 2 && y >= 2 && z >= 2) put_solid(v, x, y, z);
  });
  const double far = 1e6;
  const auto area = [&](const std::array<double, 3>& eye) { return solid_angle(v, eye) * far * far; };
  const double third = far / std::sqrt(3), half = far / std::sqrt(2);
  EXPECT_NEAR(area({10 + third, 10 + third, 10 + third}), std::sqrt(3) * 256, 0.01 * 256);
  EXPECT_NEAR(area({10 + half, 10 - half, 10}), std::sqrt(2) * 256, 0.01 * 256);
  EXPECT_NEAR(area({10, 10 - far, 10}), 256, 0.01 * 256);
}

}  // namespace
}  // namespace voxmelt::accuracy
