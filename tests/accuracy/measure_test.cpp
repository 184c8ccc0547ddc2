// Volumes whose numbers are known are measured.
#include "accuracy/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "accuracy/cells.h"

namespace voxmelt::accuracy {
namespace {

using state::Grid;
using state::Volume;

template <class Depth>  // depth(dx, dz), from the middle
Volume liquid(Grid grid, const Depth& depth) {
  Volume v(grid);
  for (int z = 0; z < grid.z; ++z)
    for (int x = 0; x < grid.x; ++x)
      put_column(v, x, z, depth(x - (grid.x - 1) / 2.0, z - (grid.z - 1) / 2.0));
  return v;
}

TEST(Measure, ColumnsAreAmountsOfLiquidOnly) {
  Volume v(Grid{3, 4, 1});
  put_inert(v, 0, 0, 0);
  put_solid(v, 1, 0, 0);
  put_column(v, 0, 0, 2.25, 1);
  put_column(v, 1, 0, 0.5, 1);
  const Columns columns(v);
  EXPECT_DOUBLE_EQ(columns.at(0, 0), 2.25);
  EXPECT_DOUBLE_EQ(columns.at(1, 0), 0.5);
  EXPECT_DOUBLE_EQ(columns.at(2, 0), 0);
  EXPECT_DOUBLE_EQ(columns.x_of(0), -1);
}

// By hand, two columns of depth 1 and 3 are at x = -2 and +2 of five.
TEST(Measure, MomentsOfTwoColumns) {
  Volume v(Grid{5, 4, 1});
  put_column(v, 0, 0, 1);
  put_column(v, 4, 0, 3);
  const Moments m = moments(Columns(v));
  EXPECT_DOUBLE_EQ(m.volume, 4);
  EXPECT_DOUBLE_EQ(m.x, 1);
  EXPECT_DOUBLE_EQ(m.z, 0);
  EXPECT_DOUBLE_EQ(m.rms_radius, 2);
  EXPECT_NEAR(m.a4, 1 + 2.0 / 3, 1e-12);  // all of it on an axis
}

// A disc's rms radius is R / sqrt 2 and it is round. A square's four-fold moment is that of the integral: 1 +
// (2/3) (28/45 - 8/9) / (28/45).
TEST(Measure, RadiusAndRoundness) {
  const auto is_in = [](double x, double z) { return std::hypot(x, z) <= 50 ? 1. : 0.; };
  const Volume disc = liquid(Grid{121, 2, 121}, is_in);
  const Moments round = moments(Columns(disc));
  EXPECT_NEAR(round.rms_radius, 50 / std::numbers::sqrt2, 0.05);
  EXPECT_NEAR(round.a4, 1, 0.005);  // its rim is a lattice's
  EXPECT_NEAR(wet_radius(Columns(disc), 0.5), 50, 0.05);
  EXPECT_EQ(wet_radius(Columns(disc), 1.5), 0);
  const Volume square = liquid(Grid{121, 2, 121}, [](double x, double z) {
    return std::max(std::abs(x), std::abs(z)) <= 50 ? 1. : 0.;
  });
  EXPECT_NEAR(moments(Columns(square)).a4, 1 + 2.0 / 3 * (28.0 / 45 - 8.0 / 9) / (28.0 / 45), 0.001);
}

TEST(Measure, ProfileErrorIsRelativeToTheMeanDepth) {
  const Volume disc =
      liquid(Grid{81, 3, 81}, [](double x, double z) { return std::hypot(x, z) <= 30 ? 1.1 : 0.; });
  const double error = profile_error(Columns(disc), [](double r) { return r <= 30 ? 1.0 : 0; });
  EXPECT_NEAR(error, 0.1, 0.001);
  const std::vector<double> rings = radial_profile(Columns(disc));
  EXPECT_NEAR(rings[0], 1.1, 0.001);
  EXPECT_NEAR(rings[20], 1.1, 0.001);
  EXPECT_EQ(rings[32], 0);
}

// A Gaussian's second moment in space is 3 sigma^2.
TEST(Measure, SecondMomentOfHeat) {
  Volume v(Grid{61, 61, 61});
  for_each_cell(v.grid, [&](int x, int y, int z) {
    const double r2 = (x - 30.) * (x - 30.) + (y - 30.) * (y - 30.) + (z - 30.) * (z - 30.);
    put_solid(v, x, y, z, 60000 * std::exp(-r2 / 72));
  });
  EXPECT_NEAR(heat_second_moment(v), 108, 0.1);
}

// With melting point 1,000 and latent heat 4,000, cells are cold, half molten, molten and hotter. A hot wall
// does not count.
TEST(Measure, MeltedCells) {
  Volume v(Grid{1, 5, 1});
  put_inert(v, 0, 4, 0);
  v.heat[v.at(0, 4, 0)] = 9000;
  const double heat[] = {500, 3000, 5000, 9000};
  for (int y = 0; y < 4; ++y) put_solid(v, 0, y, 0, heat[y]);
  EXPECT_DOUBLE_EQ(melted_cells(v, 1000, 4000), 2.5);
}

}  // namespace
}  // namespace voxmelt::accuracy
