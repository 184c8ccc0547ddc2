// Shapes whose outlines are known are measured: discs, squares, cubes, octahedra and oblique fronts.
#include "accuracy/roundness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "accuracy/cells.h"
#include "accuracy/measure.h"

namespace voxmelt::accuracy {
namespace {

using state::Grid;
using state::Volume;

// Puts columns whose depth is the part of their square, in 64 points, that `inside(x, z)` covers.
template <class Inside>
Columns covered(int side, const Inside& inside) {
  Volume v(Grid{side, 2, side});
  for (int z = 0; z < side; ++z)
    for (int x = 0; x < side; ++x) {
      double part = 0;
      for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j)
          part += inside(x + (i + 0.5) / 8 - side / 2.0, z + (j + 0.5) / 8 - side / 2.0) ? 1. / 64 : 0;
      put_column(v, x, z, part);
    }
  return Columns(v);
}

TEST(Outline, OfADisc) {
  const Outline o = outline_of(covered(141, [](double x, double z) { return std::hypot(x, z) < 60; }), 0.5);
  EXPECT_NEAR(o.mean, 60, 0.1);
  EXPECT_NEAR(o.c4, 0, 0.001);
  EXPECT_NEAR(o.c8, 0, 0.001);
  EXPECT_LT(o.rest, 0.1);
}

// The radius of a square is 1 / cos phi up to 45 degrees, and the integral of it is L = ln(1 + sqrt 2). With
// s = sin 45 that of cos 4 phi / cos phi = 8 c^3 - 8 c + 1 / c is 8 (s - s^3 / 3) - 8 s + L. That of
// cos 8 phi / cos phi = 128 c^7 - 256 c^5 + 160 c^3 - 32 c + 1 / c is 0.0194, from the integrals of odd
// powers c^n: 0.44699, 0.50676, 0.58926 and 0.70711. Each amplitude is twice that over L: -0.1394 and
// +0.0440.
TEST(Outline, OfASquare) {
  const auto square = [](double x, double z) { return std::max(std::abs(x), std::abs(z)) < 50; };
  const Outline o = outline_of(covered(161, square), 0.5);
  const double log = std::log(1 + std::numbers::sqrt2), s3 = std::pow(0.5, 1.5);
  EXPECT_NEAR(2 * (log - 8 * s3 / 3) / log, -0.1394, 1e-4);
  EXPECT_NEAR(o.mean, 50 * log / (std::numbers::pi / 4), 0.1);
  EXPECT_NEAR(o.c4, -0.1394, 0.002);
  EXPECT_NEAR(o.c8, +0.0440, 0.002);
  // Turned by 45 degrees it reaches along the axes.
  const auto diamond = [](double x, double z) { return std::abs(x) + std::abs(z) < 50; };
  EXPECT_NEAR(outline_of(covered(161, diamond), 0.5).c4, +0.1394, 0.002);
}

// In a cube of half the side a, the cone of 15 degrees about an axis has the volume pi a^3 tan^2(15) / 3.
// About the other directions its mean is summed over the cone.
double cone_of_cube(double x, double y, double z) {
  const double length = std::sqrt(x * x + y * y + z * z), least = std::cos(std::numbers::pi / 12);
  x /= length;
  y /= length;
  z /= length;
  const double flat = std::hypot(x, y), ux = flat > 0 ? -y / flat : 1, uy = flat > 0 ? x / flat : 0;
  const double vx = -z * uy, vy = z * ux, vz = x * uy - y * ux;  // u = (ux, uy, 0), v = n x u
  double sum = 0;
  constexpr int kRings = 200, kTurns = 200;
  for (int i = 0; i < kRings; ++i)
    for (int k = 0; k < kTurns; ++k) {
      const double c = least + (1 - least) * (i + 0.5) / kRings, s = std::sqrt(1 - c * c);
      const double p = s * std::cos(2 * std::numbers::pi * k / kTurns),
                   q = s * std::sin(2 * std::numbers::pi * k / kTurns);
      const double most = std::max(
          {std::abs(c * x + p * ux + q * vx), std::abs(c * y + p * uy + q * vy), std::abs(c * z + q * vz)});
      sum += std::pow(most, -3) / (kRings * kTurns);
    }
  return std::cbrt(sum);
}

TEST(Extents, OfACube) {
  const auto part = [](int x, int y, int z) {
    return std::max({std::abs(x - 29.5), std::abs(y - 29.5), std::abs(z - 29.5)}) < 20 ? 1. : 0.;
  };
  const Extents e = extents_of(Grid{60, 60, 60}, part);
  const double equal = 20 * std::cbrt(6 / std::numbers::pi);  // 4/3 pi r^3 = 8 a^3
  EXPECT_NEAR(e.radius, equal, 1e-9);
  const double t = std::tan(std::numbers::pi / 12),
               by_hand = std::cbrt(t * t / (2 * (1 - std::cos(std::numbers::pi / 12))));
  EXPECT_NEAR(cone_of_cube(0, 0, 1), by_hand, 1e-4);
  EXPECT_NEAR(e.axes, 20 * by_hand / equal, 0.003);  // 0.820
  EXPECT_NEAR(e.faces, 20 * cone_of_cube(1, 1, 0) / equal, 0.003);
  EXPECT_NEAR(e.spaces, 20 * cone_of_cube(1, 1, 1) / equal, 0.003);
  EXPECT_GT(e.spaces, e.faces);
}

TEST(Extents, OfABall) {
  const auto part = [](int x, int y, int z) {
    return std::hypot(x - 24.5, y - 24.5, z - 24.5) < 20 ? 1. : 0.;
  };
  const Extents e = extents_of(Grid{50, 50, 50}, part);
  EXPECT_NEAR(e.radius, 20, 0.05);
  for (const double one : {e.axes, e.faces, e.spaces}) EXPECT_NEAR(one, 1, 0.005);
}

TEST(FrontOf, AnObliqueLine) {
  for (const double degrees : {0., 15., 30., 45.}) {
    const double a = degrees * std::numbers::pi / 180;
    const auto behind = [&](double x, double z) { return x * std::cos(a) + z * std::sin(a) < 7.3; };
    const Front front = front_of(covered(81, behind), a, 15, 0.5);
    EXPECT_NEAR(front.place, 7.3, 0.1) << degrees;
    EXPECT_LT(front.roughness, 0.1) << degrees;
  }
}

// A front of teeth that are 4 cells long, as much wide as the gaps, lies 2 cells to and fro.
TEST(FrontOf, Teeth) {
  const auto teeth = [](double x, double z) { return x < (std::fmod(z + 1000, 16) < 8 ? 8 : 4); };
  const Front front = front_of(covered(81, teeth), 0, 32, 0.5);
  EXPECT_NEAR(front.place, 6, 0.1);
  EXPECT_NEAR(front.roughness, 2, 0.1);
}

}  // namespace
}  // namespace voxmelt::accuracy
