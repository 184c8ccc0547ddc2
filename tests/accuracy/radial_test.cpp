// Balls that melt, against formulas.
#include "accuracy/radial.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voxmelt::accuracy {
namespace {

// With a small St the heat of the melt is next to nothing, so that its temperature is that of a steady state.
// Then a front at s takes [(R^2 - s^2) / 2 - (R^3 - s^3) / (3 W)] / (D St) steps, with the wall at W. The
// next order in St adds a third to a half of St.
TEST(Radial, AMouldedBallMeltsAsTheQuasiSteadyFormulaSays) {
  constexpr double kRadius = 10, kStefan = 0.02, kDiffusivity = 0.1;
  for (const double gap : {0.0, 0.5})
    for (const double part : {0.3, 0.9}) {
      const double front = kRadius * std::cbrt(1 - part), wall = kRadius + gap;
      const double steady =
          ((kRadius * kRadius - front * front) / 2 - (std::pow(kRadius, 3) - std::pow(front, 3)) / 3 / wall) /
          (kDiffusivity * kStefan);
      const double found = MouldedBall{kRadius, gap, kDiffusivity, kStefan}.time_of(part);
      EXPECT_NEAR(found / steady, 1, 0.015) << gap << " " << part;
    }
}

// By hand: at 7/8 the radius has halved.
TEST(Radial, ABaredBallShrinksSteadily) {
  EXPECT_NEAR((BaredBall{10, 0.05}.time_of(7.0 / 8)), 100, 1e-9);
  EXPECT_NEAR((BaredBall{10, 0.05}.time_of(1)), 200, 1e-9);
}

}  // namespace
}  // namespace voxmelt::accuracy
