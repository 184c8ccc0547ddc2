// Everything is at its maximum, for long.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "kernel/automaton/rule/heat.h"
#include "tests/kernel/engine/scalar/hostile.h"

namespace voxmelt::scalar {
namespace {

using namespace worlds;

void expect_sound(const run::Simulation& s) {
  ASSERT_EQ(broken_invariant(s.volume(), s.parameters()), "") << "step " << s.steps_done();
  ASSERT_TRUE(s.drift().none()) << "step " << s.steps_done();
}

// A closed container, filled to the last unit, stays exactly as it is, because nothing can move.
TEST(FullBox, StaysAsItIs) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
    for (const bool downhill : {false, true}) {
      Parameters p = law == rule::Law::paper ? paper_showcase() : viscous(1000);
      p.flow.paper.downhill = downhill;
      Volume v(Grid{4, 5, 3});
      const std::int32_t energy = law == rule::Law::paper ? 65535 : 0;
      fill(v, whole(v.grid), 65535, energy);
      run::Simulation s = simulate(p, v);
      for (int i = 0; i < 20000; ++i) s.step();
      EXPECT_EQ(s.volume().amount, v.amount);
      expect_sound(s);
    }
}

// A box with one cell less is over-filled everywhere, moves for ever, and never loses a unit.
TEST(FullBox, WithALittleRoomNeverLosesAUnit) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      Random random(seed);
      Parameters p = law == rule::Law::paper ? paper_showcase() : viscous(1000);
      if (law == rule::Law::paper) hostile_paper_law(random, p.flow.paper);
      Volume v(Grid{4, 5, 3});
      fill(v, whole(v.grid), 65535, law == rule::Law::paper ? 65535 : 0);
      put(v, 1, 4, 1, 0);
      put(v, 2, 2, 1, 30000);
      put_inert(v, 0, 2, 2);
      run::Simulation s = simulate(p, v);
      for (int i = 0; i < 20000; ++i) {
        s.step();
        if (i % 100 == 0) expect_sound(s);
      }
      expect_sound(s);
    }
}

// Temperatures lie at both ends and one unit inside, and all neighbours are at the bound of docs/proofs.md.
// Heat never leaves 0..65535 (a wrap would be a jump from cold to hot), and conduction creates no new
// extreme.
TEST(Heat, StaysBetweenItsExtremes) {
  for (const int neighbours : {6, 18, 26})
    for (const auto& [cold_end, hot_end] :
         {std::pair{0, 65535}, {1, 65534}, {0, 1}, {65534, 65535}, {1, 2}, {32768, 32769}})
      for (std::uint64_t seed = 0; seed < 3; ++seed) {
        const int low = cold_end, high = hot_end;
        Random random(seed);
        Parameters p = paper_showcase();
        p.heat.enabled = true;
        p.heat.neighbours = neighbours;
        p.heat.weight_face = 10922;
        p.heat.weight_edge = 5461;
        p.heat.weight_corner = 3640;
        p.material.melting_point = 65535;
        Volume v(Grid{7, 7, 7});
        // The patterns are a checkerboard, lone cells, and noise.
        for_each(whole(v.grid), [&](int x, int y, int z) {
          const bool hot = seed == 0   ? (x + y + z) % 2 == 0
                           : seed == 1 ? x % 3 == 1 && y % 3 == 1 && z % 3 == 1
                                       : random.one_in(2);
          put_solid(v, x, y, z, kOne, std::min(65534, hot ? high : low));
        });
        run::Simulation s = simulate(p, v);
        const std::int64_t total = static_cast<std::int64_t>(state::holdings(v).heat);
        for (int i = 0; i < 600; ++i) {
          s.step();
          for_each(whole(v.grid), [&](int x, int y, int z) {
            const std::int32_t h = s.volume().heat[v.at(x, y, z)];
            ASSERT_TRUE(low <= h && h <= high) << "step " << i;
          });
          ASSERT_EQ(static_cast<std::int64_t>(state::holdings(s.volume()).heat), total)
              << "equal amounts: the sum is kept";
        }
        expect_sound(s);
      }
}

// A weight of 10923 does leave the range: with 16 bits, the coldest cell becomes the hottest.
TEST(Heat, PastTheBoundItWraps) {
  for (const std::uint16_t weight : {std::uint16_t{10922}, std::uint16_t{10923}}) {
    Parameters p = paper_showcase();
    p.heat.enabled = true;
    p.heat.weight_face = weight;
    p.material.melting_point = 65535;
    Volume v(Grid{7, 7, 7});
    for_each(whole(v.grid), [&](int x, int y, int z) { put_solid(v, x, y, z, kOne, (x + y + z) % 2); });
    run::Simulation s = simulate(p, v);
    std::uint16_t hottest = 0;
    for (int i = 0; i < 16; ++i) {
      s.step();
      for (const std::uint16_t h : s.volume().heat.stored()) hottest = std::max(hottest, h);
    }
    EXPECT_EQ(hottest > 1, weight == 10923) << hottest;
  }
}

// Convection, hot and cold air and latent heat act in liquid, all at once and at the bound.
TEST(Heat, OvenAndConvectionStayBetweenTheAirs) {
  for (const int latent : {0, 20000})
    for (const auto& [cold_end, hot_end] : {std::pair{0, 65535}, {1, 65534}}) {
      const int low = cold_end, high = hot_end;
      Parameters p = viscous(0.02);
      p.heat.enabled = p.heat.air = true;
      p.heat.neighbours = 26;
      p.heat.weight_face = 10922;
      p.heat.weight_edge = 5461;
      p.heat.weight_corner = 3640;
      p.heat.convection = 32767;
      p.heat.air_exchange = 43690;
      p.material = {30000, static_cast<rule::Temperature>(latent)};
      Volume v(Grid{6, 8, 6});
      for (int y = 0; y < v.grid.y; ++y)
        p.heat.air_temperature.push_back(static_cast<rule::Temperature>(y % 2 ? low : high));
      for_each({1, 0, 1, 5, 6, 5},
               [&](int x, int y, int z) { put(v, x, y, z, 4096, 0, (x + y + z) % 2 ? high : low); });
      run::Simulation s = simulate(p, v);
      for (int i = 0; i < 1000; ++i) {
        s.step();
        for_each(whole(v.grid), [&](int x, int y, int z) {
          const state::Slot c = v.at(x, y, z);
          if (s.volume().amount[c] == 0) return;
          const std::int32_t t = rule::temperature_of(s.volume().heat[c], p.material);
          ASSERT_TRUE(low <= t && t <= high) << i;
        });
      }
      expect_sound(s);
    }
}

}  // namespace
}  // namespace voxmelt::scalar
