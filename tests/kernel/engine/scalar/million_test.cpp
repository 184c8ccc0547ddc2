// The drift is 0 after a million steps of a scene that never rests. The test is slow: half an hour.
#include <gtest/gtest.h>

#include "tests/kernel/engine/scalar/moving_scene.h"

namespace voxmelt::scalar {
namespace {

TEST(MovingScene, MillionStepsPaper) {
  run::Simulation s = worlds::moving_scene(rule::Law::paper);
  EXPECT_EQ(worlds::keeps_its_books(s, 1000000), "");
}

TEST(MovingScene, MillionStepsViscous) {
  run::Simulation s = worlds::moving_scene(rule::Law::viscous);
  EXPECT_EQ(worlds::keeps_its_books(s, 1000000), "");
}

}  // namespace
}  // namespace voxmelt::scalar
