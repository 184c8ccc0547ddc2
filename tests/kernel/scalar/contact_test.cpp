// What a flow touches: the corner it passes, the ground under its receiver, the bed beside it.
#include <gtest/gtest.h>

#include "tests/kernel/worlds.h"

namespace voxmelt::scalar {
namespace {

using namespace worlds;

// One blocked cell does not bar a diagonal: it is reached in the very first step, not by way of the other
// side.
TEST(Contact, ADiagonalPassesOneBlockedCell) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    int reached = 0;
    for (std::uint64_t seed = 1; seed <= 32; ++seed) {
      Volume v(Grid{2, 1, 2});
      put(v, 0, 0, 0, kOne, law == rule::Law::paper ? kOne : 0);
      put_solid(v, 1, 0, 0);
      Parameters p = law == rule::Law::paper ? paper_showcase() : viscous(10);
      p.seed = seed;
      run::Simulation s = simulate(p, v);
      steps(s, 1);
      reached += amount_at(s, 1, 0, 1) > 0;
    }
    EXPECT_GT(reached, 4);
  }
}

// Friction is that of the receiver's own ground: what arrives on a floor that takes everything has no energy.
TEST(Contact, FrictionIsThatOfTheReceiversGround) {
  for (const bool floor_takes_all : {false, true}) {
    std::int64_t arrived = 0, energy = 0;
    for (std::uint64_t seed = 1; seed <= 32; ++seed) {
      Volume v(Grid{2, 3, 1});
      put(v, 0, 0, 0, kOne, kOne);
      Parameters p = paper_showcase();
      p.seed = seed;
      p.flow.paper.alpha_liquid = floor_takes_all ? 65535 : 0;
      p.flow.paper.alpha_floor = floor_takes_all ? 0 : 65535;
      run::Simulation s = simulate(p, v);
      steps(s, 1);
      arrived += amount_at(s, 1, 0, 0);
      energy += s.volume().energy[v.at(1, 0, 0)];
    }
    ASSERT_GT(arrived, kOne);
    EXPECT_EQ(energy > 0, !floor_takes_all);
  }
}

// A dry bed that stands as high as the liquid beside it takes nothing; a lower one does.
TEST(Contact, ADryBedHasItsOwnHeight) {
  for (const int rise : {0, 1024}) {
    Volume v(Grid{2, 3, 1});
    put_inert(v, 0, 0, 0);
    put_inert(v, 1, 0, 0, rule::kBedHalf + rise);
    put(v, 0, 1, 0, 1024);
    run::Simulation s = simulate(viscous(10), v);
    steps(s, 20);
    EXPECT_EQ(amount_at(s, 1, 1, 0) > 0, rise == 0);
  }
}

}  // namespace
}  // namespace voxmelt::scalar
