// The books balance over a long run (the million steps are in million_test.cpp).
#include <gtest/gtest.h>

#include "tests/kernel/engine/scalar/moving_scene.h"

namespace voxmelt::scalar {
namespace {

TEST(MovingScene, FourThousandSteps) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    run::Simulation s = worlds::moving_scene(law);
    EXPECT_EQ(worlds::keeps_its_books(s, 2000), "");
    EXPECT_GT(s.ledger().mass.removed, 0);
  }
}

}  // namespace
}  // namespace voxmelt::scalar
