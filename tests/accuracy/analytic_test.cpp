// The exact answers are held against published numbers, and against the equations that they solve.
#include "accuracy/analytic.h"
#include "accuracy/two_layers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace voxmelt::accuracy {
namespace {

// Tables have lambda of the one-phase problem to six digits.
TEST(Analytic, StefanLambda) {
  EXPECT_NEAR(stefan_lambda(0.041), 0.142215, 1e-6);
  EXPECT_NEAR(stefan_lambda(0.1), 0.220016, 1e-6);
  EXPECT_NEAR(stefan_lambda(0.5), 0.464786, 1e-6);
  EXPECT_NEAR(stefan_lambda(1), 0.620063, 1e-6);
  EXPECT_NEAR(stefan_lambda(2), 0.800601, 1e-6);
  EXPECT_NEAR(stefan_lambda(10), 1.256972, 1e-6);
}

// Without a cold solid the two problems are one. A cold solid slows the front.
TEST(Analytic, TwoPhaseStefanLambda) {
  for (const double stefan : {0.05, 0.5, 2.0}) {
    EXPECT_NEAR(stefan_lambda(stefan, 0), stefan_lambda(stefan), 1e-9);
    EXPECT_LT(stefan_lambda(stefan, 0.5), 0.95 * stefan_lambda(stefan));
  }
}

// The front moves as fast as the latent heat of the difference of the two flows of heat lets it. Slopes are
// taken by finite differences of the temperature, which must also solve the heat equation on both sides.
TEST(Analytic, TwoPhaseStefanTemperatureKeepsItsBooks) {
  const double d = 0.1, time = 3000, stefan = 1, cold = 0.5, e = 1e-3;
  const double front = 2 * stefan_lambda(stefan, cold) * std::sqrt(d * time);
  const auto at = [&](double x, double t) { return stefan_temperature(x, t, d, stefan, cold); };
  EXPECT_NEAR(at(0, time), 1, 1e-12);
  EXPECT_NEAR(at(front, time), 0, 1e-9);
  EXPECT_NEAR(at(1000, time), -0.5, 1e-9);
  const double hot_side = (at(front - e, time) - at(front - 2 * e, time)) / e;
  const double cold_side = (at(front + 2 * e, time) - at(front + e, time)) / e;
  const double speed = front / (2 * time), latent = 1 / stefan;
  EXPECT_NEAR(latent * speed, d * (cold_side - hot_side), 1e-3 * latent * speed);
  for (const double x : {front / 2, 2 * front}) {
    const double curvature = at(x + 1, time) - 2 * at(x, time) + at(x - 1, time);
    const double change = (at(x, time + 1) - at(x, time - 1)) / 2;
    EXPECT_NEAR(change, d * curvature, 1e-3 * std::abs(change));
  }
}

TEST(Analytic, SlabStartsColdAndEndsWarm) {
  EXPECT_NEAR(slab_temperature(32, 10, 0.1, 64), 0, 1e-2);  // a series of 200 terms
  EXPECT_NEAR(slab_temperature(32, 1e6, 0.1, 64), 1, 1e-9);
  // Early, the insulated end is not felt: 1 - erf(x / 2 sqrt(D t)).
  EXPECT_NEAR(slab_temperature(8, 400, 0.1, 64), 1 - std::erf(8 / (2 * std::sqrt(40.0))), 1e-6);
}

// Huppert (1982) has 0.894 and 1.411. The volumes under the profiles are those that were asked for.
TEST(Analytic, HuppertConstants) {
  EXPECT_NEAR((Drop{3, 1}.front(1)), 0.89391, 1e-5);
  EXPECT_NEAR((Dam{3, 1}.front(1)), 1.41124, 1e-5);
  const Drop drop{0.02, 9000};
  const Dam dam{0.02, 500};
  EXPECT_NEAR(drop.front(256) / drop.front(1), 2, 1e-12);
  EXPECT_NEAR(dam.front(32) / dam.front(1), 2, 1e-12);
  EXPECT_NEAR(drop.time_of_front(drop.front(77)), 77, 1e-9);
  EXPECT_NEAR(dam.time_of_front(dam.front(77)), 77, 1e-9);
  double volume = 0, area = 0, second = 0;
  for (double r = 0.005; r < drop.front(100); r += 0.01) {
    volume += 2 * std::numbers::pi * r * drop.height(r, 100) * 0.01;
    second += 2 * std::numbers::pi * r * r * r * drop.height(r, 100) * 0.01;
  }
  for (double x = 0.005; x < dam.front(100); x += 0.01) area += dam.height(x, 100) * 0.01;
  EXPECT_NEAR(volume, 9000, 1);
  EXPECT_NEAR(area, 500, 0.1);
  EXPECT_NEAR(std::sqrt(second / volume), drop.rms_radius(100), 1e-3);
}

// Huppert has 0.715 for the front. The other digits are those of a second program: it integrates the profile
// in y instead of log y, for phi^4 / 4 and the flux. The volume is the flux times the time.
TEST(Analytic, CurrentOfConstantFlux) {
  const FedCurrent unit{3, 1};
  EXPECT_NEAR(unit.front(1), 0.715016, 1e-5);
  EXPECT_NEAR(unit.rms_radius(1) / unit.front(1), 0.635557, 1e-5);
  const FedCurrent current{0.02, 5};
  EXPECT_NEAR(current.front(400) / current.front(100), 2, 1e-12);
  const double end = current.front(100);
  double volume = 0, second = 0;
  for (double r = 0.005; r < end; r += 0.01) {
    volume += 2 * std::numbers::pi * r * current.height(r, 100) * 0.01;
    second += 2 * std::numbers::pi * r * r * r * current.height(r, 100) * 0.01;
  }
  EXPECT_NEAR(volume, 500, 0.2);
  EXPECT_NEAR(std::sqrt(second / volume), current.rms_radius(100), 1e-3);
  EXPECT_EQ(current.height(1.001 * end, 100), 0);
}

// Trigonometry gives sin(a) cos(a)^3.
TEST(Analytic, NusseltIsOfTheDepthAlongGravity) {
  for (const double slope : {0.1, 0.25, 0.5, 1.0}) {
    const double angle = std::atan(slope);
    EXPECT_NEAR(nusselt(slope), std::sin(angle) * std::pow(std::cos(angle), 3), 1e-12);
  }
  EXPECT_NEAR(nusselt(0.5), 0.32, 1e-12);
}

// By hand: a flux of 0.1 at kappa 0.3 makes an upright film of 1 cell, and one of 2^(1/3) cells at 30
// degrees. Where a plane is as steep, its film of the same depth along gravity carries the same.
TEST(Analytic, CylinderFilm) {
  EXPECT_NEAR(cylinder_film(0.3, 0.1, std::numbers::pi / 2), 1, 1e-12);
  EXPECT_NEAR(cylinder_film(0.3, 0.1, std::numbers::pi / 6), 1.2599210498948732, 1e-12);
  for (const double angle : {0.2, 0.7, 1.2}) {
    const double along_gravity = cylinder_film(0.2, 0.03, angle) / std::cos(angle);
    EXPECT_NEAR(0.2 / 3 * nusselt(std::tan(angle)) * std::pow(along_gravity, 3), 0.03, 1e-12);
  }
}

// By hand, 600 cells in shafts of 60 columns have a roof over 60 more at height 4. So 60 h + 60 (4 + o) = 600
// and h - 4 = 8 o, which gives h = 52 / 9. Then 243 cells in 18 columns, 9 of them roofed at 3, give 18 h + 9
// (3 + o) = 243, so h = 195 / 17.
TEST(Analytic, ConduitLevel) {
  EXPECT_NEAR(conduit_level(600, 60, 60, 4, 8), 52.0 / 9, 1e-12);
  EXPECT_NEAR(conduit_level(243, 18, 9, 3, 8), 195.0 / 17, 1e-12);
  EXPECT_NEAR(conduit_level(600, 60, 60, 4, 1), 5, 1e-12);  // as soft as open water: all columns alike
  EXPECT_NEAR(conduit_level(600, 60, 60, 4, std::numeric_limits<double>::infinity()), 6, 1e-12);
}

TEST(Analytic, Rest) {
  EXPECT_NEAR(diffusivity(0.3, 6), 0.095493, 1e-6);
  EXPECT_NEAR(diffusivity(0.3, 26) / diffusivity(0.3, 6), 4.3333, 1e-4);
  EXPECT_NEAR(diffusivity(0.3, 18) / diffusivity(0.3, 6), 3, 1e-12);
  EXPECT_NEAR(ball_intercepts(20, 1000), std::numbers::pi * 0.0004, 2e-7);  // far away: the disc
  EXPECT_NEAR(ball_intercepts(1, 1), 2 * std::numbers::pi, 1e-12);          // touching: half of all
}

// Finite volumes follow the similarity profile from depth 4 to 2, and the volume stays.
TEST(Analytic, LubricationFlowFollowsHuppert) {
  constexpr int kParts = 4;
  const Dam dam = dam_of_depth(0.05, 4, 24);
  const double age = dam.time_of_front(24);
  EXPECT_NEAR(dam.height(0, age), 4, 1e-9);
  std::vector<double> depth(64 * kParts);
  const auto at = [](std::size_t i) { return (static_cast<double>(i) + 0.5) / kParts; };
  for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = dam.height(at(i), age);
  const std::vector<double> later = lubrication_flow(0.05, depth, 31 * age, kParts);
  double before = 0, after = 0, second = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    before += depth[i];
    after += later[i];
    second += later[i] * at(i) * at(i);
    if (at(i) < 40) {
      EXPECT_NEAR(later[i], dam.height(at(i), 32 * age), 0.02) << at(i);
    }
  }
  EXPECT_NEAR(after, before, 1e-9 * before);
  EXPECT_NEAR(std::sqrt(second / after), dam.rms_length(32 * age), 0.005 * 24);
  EXPECT_NEAR(dam.rms_length(1) / dam.front(1), 0.522233, 1e-6);  // sqrt(3 / 11)
}

// Two layers of one material are a slab.
TEST(Analytic, TwoLayersOfOneMaterialAreASlab) {
  const TwoLayers layers{{20, 44}, {0.1, 0.1}, {1, 1}};
  for (const double time : {400.0, 5000.0, 20000.0})
    for (const double x : {1.0, 19.0, 21.0, 64.0})
      EXPECT_NEAR(layers.temperature(x, time), slab_temperature(x, time, 0.1, 64), 1e-9) << x << ' ' << time;
  EXPECT_NEAR(layers.temperature(30, layers.time_of(30, 0.4)), 0.4, 1e-5);
}

// The sum solves the heat equation in each layer. At the border temperature and flow of heat are continuous.
TEST(Analytic, TwoLayersConductAndMeet) {
  const TwoLayers layers{{20, 30}, {0.1, 0.4}, {1, 2}};
  const double time = 3000, e = 1e-2, near = 1e-6;
  const auto at = [&](double x, double t) { return layers.temperature(x, t); };
  for (const double x : {7.0, 35.0}) {
    const double d = x < 20 ? 0.1 : 0.4 / 2;
    const double bend = (at(x + e, time) - 2 * at(x, time) + at(x - e, time)) / (e * e);
    const double growth = (at(x, time + 1) - at(x, time - 1)) / 2;
    EXPECT_NEAR(growth, d * bend, 1e-3 * std::abs(growth)) << x;
  }
  EXPECT_NEAR(at(20 - near, time), at(20 + near, time), 1e-6);
  const double before = (at(20 - near, time) - at(20 - near - e, time)) / e,
               after = (at(20 + near + e, time) - at(20 + near, time)) / e;
  EXPECT_NEAR(0.1 * before, 0.4 * after, 1e-2 * std::abs(0.1 * before));
  // All heat that comes in through the wall stays: its sum grows by what flows in.
  const auto heat = [&](double t) {
    double sum = 0;
    for (double x = 0.05; x < 50; x += 0.1) sum += 0.1 * (x < 20 ? 1 : 2) * at(x, t);
    return sum;
  };
  const double inflow = 0.1 * (at(0, time) - at(e, time)) / e;
  EXPECT_NEAR((heat(time + 10) - heat(time - 10)) / 20, inflow, 1e-3 * inflow);
}

}  // namespace
}  // namespace voxmelt::accuracy
