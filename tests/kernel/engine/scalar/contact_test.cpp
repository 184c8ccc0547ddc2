// A flow depends on what it touches: the corner it passes, the ground under its receiver, the bed beside it.
#include <gtest/gtest.h>

#include <cstdint>

#include "tests/kernel/worlds.h"

namespace voxmelt::scalar {
namespace {

using namespace worlds;

// One blocked cell does not bar a diagonal. The diagonal cell is reached in the very first step, not by way
// of the other side.
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

// Friction is that of the receiver's own ground: liquid that arrives on a floor that takes everything has no
// energy.
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

// A dry bed that stands as high as the liquid beside it takes nothing. A lower one does.
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

// The same on a solid: its bed follows from its amount, and sinks while it melts. In the last case it has
// taken up three quarters of its latent heat, and its bed lies 5/16 above its lower face.
TEST(Contact, ASolidBedHasItsOwnHeight) {
  struct Case {
    std::int32_t amount, heat;
    bool takes;
  };
  for (const Case& one :
       {Case{5120, 0, false}, Case{4096, 0, true}, Case{5120, 29999, false}, Case{5120, 45000, true}}) {
    Volume v(Grid{2, 3, 1});
    put_inert(v, 0, 0, 0);
    put_solid(v, 1, 0, 0, one.amount, one.heat);
    put(v, 0, 1, 0, 1024, 0, 50000);
    Parameters p = viscous(10);
    p.heat.enabled = true;
    p.material = {.melting_point = 30000, .latent_heat = 20000};
    run::Simulation s = simulate(p, v);
    steps(s, 20);
    EXPECT_EQ(amount_at(s, 1, 1, 0) > 0, one.takes) << one.amount << ' ' << one.heat;
  }
}

// Returns the step in which a film that touches one solid falls. The solid melts in step 0.
int falls_in(rule::Law law, const rule::Fall& fall, int dx, int dy, int dz) {
  Volume v(Grid{5, 7, 5});
  put(v, 2, 3, 2, 900, 0, 20000);
  put_solid(v, 2 + dx, 3 + dy, 2 + dz, kOne, 40000);
  if (dy == 0) put_inert(v, 2 + dx, 2, 2 + dz);  // the molten cell stays there
  Parameters p = law == rule::Law::paper ? paper_showcase() : viscous(0);
  p.flow.fall = fall;
  p.flow.paper.threshold = 65535;
  p.flow.paper.slump = 0;
  p.heat.enabled = true;
  p.material.melting_point = 30000;
  run::Simulation s = simulate(p, v);
  for (int step = 0; step < 4; ++step) {
    s.step();
    EXPECT_EQ(s.volume().solid.count(), 0);
    if (amount_at(s, 2, 2, 2) == 900) return step;
    EXPECT_EQ(amount_at(s, 2, 3, 2), 900);
  }
  return -1;
}

// Under the paper's law a side that melts still holds in that step. A solid above does not, and under the
// viscous law no molten solid does.
TEST(Contact, ASideHoldsInTheStepInWhichItMelts) {
  const rule::Fall drip{.factor = 65536, .wall_factor = 65536, .minimum = 0, .hang = 1024};
  const rule::Fall adhesion{.factor = 65536, .wall_factor = 0, .minimum = 0, .hang = 0};
  constexpr int kSides[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  for (const rule::Fall& fall : {drip, adhesion})
    for (const auto& [dx, dz] : kSides) {
      EXPECT_EQ(falls_in(rule::Law::paper, fall, dx, 0, dz), 1) << dx << dz;
      EXPECT_EQ(falls_in(rule::Law::viscous, fall, dx, 0, dz), 0) << dx << dz;
    }
  EXPECT_EQ(falls_in(rule::Law::paper, drip, 0, 1, 0), 0);
  EXPECT_EQ(falls_in(rule::Law::viscous, drip, 0, 1, 0), 0);
}

// Phases run apart. A melt is forgotten when gravity has run, and by another melt.
TEST(Contact, OnlyTheLastMeltCounts) {
  Parameters p = paper_showcase();
  p.flow.fall.hang = 1024;
  p.heat.enabled = true;
  p.material.melting_point = 30000;
  for (const step::Phase between : {step::Phase::gravity, step::Phase::melt, step::Phase::source}) {
    Volume v(Grid{5, 7, 5});
    put(v, 2, 3, 2, 900, 0, 20000);
    put_solid(v, 1, 3, 2, kOne, 40000);
    put_inert(v, 1, 2, 2);
    run::Simulation s = simulate(p, v);
    s.run_phase(step::Phase::melt);
    s.run_phase(between);
    EXPECT_EQ(amount_at(s, 2, 3, 2), 900);
    s.run_phase(step::Phase::gravity);
    EXPECT_EQ(amount_at(s, 2, 2, 2), between == step::Phase::source ? 0 : 900);
  }
}

}  // namespace
}  // namespace voxmelt::scalar
