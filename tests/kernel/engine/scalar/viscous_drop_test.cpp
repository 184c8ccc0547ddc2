// Drops on a plane are compared with Huppert 1982 (quick; the gates with their long runs are elsewhere). Heat
// is carried with the flow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "tests/kernel/measure.h"

namespace voxmelt::scalar {
namespace {

using namespace worlds;

// The similarity solution of constant volume is h = h0 (1 - (r / rn)^2)^(1/3), rn = 0.89391 (kappa V^3 /
// 3)^(1/8) t^(1/8).
struct Huppert {
  double kappa, volume, time;  // for the profile that the run starts from
  double front(double t) const { return 0.89391 * std::pow(kappa * volume * volume * volume / 3 * t, 0.125); }
  double rms(double t) const { return front(t) * std::sqrt(3.0 / 7); }
};

Huppert put_profile(Volume& v, double kappa, double front, double depth) {
  const double volume = 0.75 * std::numbers::pi * front * front * depth;
  for_each(whole(v.grid), [&](int x, int y, int z) {
    const double s = std::hypot(x - (v.grid.x - 1) / 2.0, z - (v.grid.z - 1) / 2.0) / front;
    const double h = s < 1 ? depth * std::cbrt(1 - s * s) : 0;
    put(v, x, y, z, static_cast<std::int32_t>(std::clamp(h - y, 0.0, 1.0) * kOne));
  });
  const Huppert at_one{kappa, volume, 1};
  return {kappa, volume, std::pow(front / at_one.front(1), 8)};
}

// The depth falls from 3 to 1.5 in 16 times the time. Measured are exponent 0.126, radius +0.8 %, and |a4 -
// 1| 0.6 and 0.14 %.
TEST(Huppert, RadiusExponentAndRoundness) {
  Volume v(Grid{45, 5, 45});
  const Huppert theory = put_profile(v, 0.02, 10, 3);
  run::Simulation s = simulate(viscous(0.02), v);
  const auto run_to = [&](double factor) {
    const int target = static_cast<int>(theory.time * (factor - 1));
    steps(s, target - static_cast<int>(s.steps_done()));
    return spread_of(heights(s.volume()));
  };
  const Spread early = run_to(4), late = run_to(16);
  const double exponent = std::log(late.radius / early.radius) / std::log(4.0);
  RecordProperty("exponent", std::to_string(exponent));
  RecordProperty("radius_error", std::to_string(late.radius / theory.rms(16 * theory.time) - 1));
  RecordProperty("anisotropy", std::to_string(late.anisotropy));
  EXPECT_NEAR(exponent, 0.125, 0.01);
  EXPECT_NEAR(early.radius / theory.rms(4 * theory.time), 1, 0.02);
  EXPECT_NEAR(late.radius / theory.rms(16 * theory.time), 1, 0.02);
  EXPECT_LE(early.anisotropy, 0.01);
  EXPECT_LE(late.anisotropy, 0.005);
}

// Conduction is off, so heat moves with the liquid only. The sum of A h changes by `rounded` alone, and by
// little.
TEST(HeatWithFlow, IsCarriedExactly) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    Parameters p = law == rule::Law::paper ? paper_showcase() : viscous(0.05);
    p.heat.enabled = true;
    p.material.melting_point = 65535;
    Volume v(Grid{31, 12, 31});
    for_each({0, 0, 0, 31, 1, 31},
             [&](int x, int y, int z) { put(v, x, y, z, 2048, law == rule::Law::paper ? 2048 : 0, 10000); });
    for_each({12, 1, 12, 19, 8, 19},
             [&](int x, int y, int z) { put(v, x, y, z, kOne, law == rule::Law::paper ? kOne : 0, 60000); });
    run::Simulation s = simulate(p, v);
    const state::Sum start = state::holdings(v).heat;
    steps(s, 400);
    const state::Sum end = state::holdings(s.volume()).heat;
    EXPECT_EQ(end - start, s.ledger().heat.rounded);
    EXPECT_LT(std::abs(static_cast<double>(end - start)), 1e-4 * static_cast<double>(start));
    // The liquid has spread and mixed, and made no new extreme.
    int warm = 0;
    for_each(whole(v.grid), [&](int x, int y, int z) {
      const state::Slot i = v.at(x, y, z);
      if (s.volume().amount[i] == 0) return;
      ASSERT_TRUE(s.volume().heat[i] >= 10000 && s.volume().heat[i] <= 60000);
      warm += s.volume().heat[i] > 10000;
    });
    EXPECT_GT(warm, 300);
    RecordProperty("rounded", state::to_string(end - start));
  }
}

}  // namespace
}  // namespace voxmelt::scalar
