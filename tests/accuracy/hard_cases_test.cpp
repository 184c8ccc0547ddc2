// Each hard case of the physics has its number. Others stand where their rule is tested: the list is in
// docs/verification.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "kernel/automaton/state/digest.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::worlds {
namespace {

run::Simulation simulate_with(const step::Implementation& implementation, const Parameters& p,
                              const Volume& v) {
  return {p, v, implementation};
}

// These one-phase Stefan problems are far from the usual: hardly any heat, and ten times the latent heat.
// Lambda solves lambda exp(lambda^2) erf(lambda) = St / sqrt(pi). It is 0.070593 and 1.256972 by bisection.
TEST(HardCase, StefanNumbersOfAHundredthAndOfTen) {
  struct {
    double stefan, lambda;
  } const cases[] = {{0.01, 0.070593}, {10, 1.256972}};
  for (const auto& c : cases) {
    const int cells = 32, melting = 1000;
    const double span = 64000, latent = std::round(span / (1 + c.stefan)), front = 24;
    Parameters p = paper_showcase();
    p.heat.enabled = p.heat.air = true;
    p.heat.weight_face = 6258;       // gamma 0.3
    p.heat.air_exchange = 2 * 6258;  // a wall half a cell from the uppermost centre
    p.heat.air_temperature.assign(cells + 1, static_cast<rule::Temperature>(melting + c.stefan * latent));
    p.material = {melting, static_cast<rule::Temperature>(latent)};
    Volume v(Grid{1, cells + 1, 1});
    for (int y = 0; y < cells; ++y) put_solid(v, 0, y, 0, kOne, melting);
    run::Simulation s = simulate(p, v);
    steps(s, static_cast<int>(std::pow(front / (2 * c.lambda), 2) / (6258 / 65536.0)));
    double taken = 0;
    for (int y = 0; y < cells; ++y)
      taken += std::min(1.0, (s.volume().heat[v.at(0, y, 0)] - melting) / latent);
    EXPECT_NEAR(taken / front, 1, 0.01) << c.stefan;
    RecordProperty("error", std::to_string(taken / front - 1));
  }
}

// Hot and cold cells alternate. In a step their difference is multiplied by 1 - 12 gamma / pi with 6 and 18
// neighbours, as edges join cells of one colour. With 26 it is also multiplied by 1 - 16 gamma / (3 pi). So
// it is halved at gamma pi / 8, it stays at pi / 6, and corners leave a ninth of it there.
TEST(HardCase, ACheckerboardOfHeatIsDamped) {
  struct {
    int neighbours, face;  // 65536 gamma / pi
    double factor;
  } const cases[] = {{6, 8191, -0.5},       {18, 8191, -0.5}, {26, 8191, -1 / 6.0}, {6, 10922, -1},
                     {26, 10922, -1 / 9.0}, {6, 5461, 0},     {18, 5461, 0}};
  for (const auto& c : cases) {
    Parameters p = paper_showcase();
    p.heat.enabled = true;
    p.heat.neighbours = c.neighbours;
    p.heat.weight_face = static_cast<std::uint16_t>(c.face);
    p.heat.weight_edge = static_cast<std::uint16_t>(c.face / 2);
    p.heat.weight_corner = static_cast<std::uint16_t>(c.face / 3);
    p.material.melting_point = 65535;
    Volume v(Grid{9, 9, 9});
    for_each(whole(v.grid),
             [&](int x, int y, int z) { put_solid(v, x, y, z, kOne, (x + y + z) % 2 == 0 ? 60000 : 0); });
    run::Simulation s = simulate(p, v);
    s.step();
    const double swing = s.volume().heat[v.at(4, 4, 4)] - 30000.0;
    EXPECT_NEAR(swing / 30000, c.factor, 0.001) << c.neighbours << " neighbours, face " << c.face;
  }
}

// A cell melts at exactly the melting point, and one unit below it does not. The same holds with latent heat.
TEST(HardCase, MeltsAtExactlyTheMeltingPoint) {
  for (const int latent : {0, 20000}) {
    Parameters p = paper_showcase();
    p.heat.enabled = true;
    p.material = {30000, static_cast<rule::Temperature>(latent)};
    Volume v(Grid{3, 1, 1});
    put_solid(v, 0, 0, 0, kOne, 30000 + latent - 1);
    put_solid(v, 2, 0, 0, kOne, 30000 + latent);
    run::Simulation s = simulate(p, v);
    s.step();
    EXPECT_TRUE(s.volume().solid.test(0, 0, 0));
    EXPECT_FALSE(s.volume().solid.test(2, 0, 0));
    EXPECT_EQ(state::holdings(s.volume()).liquid, kOne);
  }
}

// Nothing seeps out of a tank with walls one cell thick and a lid, filled to the brim with over-full cells.
TEST(HardCase, WallsOfOneCellAreTight) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    Parameters p = law == rule::Law::paper ? paper_showcase() : viscous(20);
    Volume v(Grid{12, 10, 12});
    fill_inert(v, {2, 1, 2, 10, 9, 10});
    const Box inside{3, 2, 3, 9, 8, 9};
    for_each(inside, [&](int x, int y, int z) {
      v.inert.set(x, y, z, false);
      put(v, x, y, z, x < 6 ? kOne : 2 * kOne, law == rule::Law::paper ? kOne : 0);
    });
    run::Simulation s = simulate(p, v);
    steps(s, 500);
    std::int64_t held = 0;
    for_each(inside, [&](int x, int y, int z) { held += amount_at(s, x, y, z); });
    EXPECT_EQ(held, 6 * 6 * (3 * 1 + 3 * 2) * kOne);  // half of the columns hold one, half two
    EXPECT_EQ(state::holdings(s.volume()).liquid, held);
    EXPECT_TRUE(s.drift().none());
  }
}

// A drop of 65535 units falls apart. Nothing is lost, and in the end no cell in the open holds more than one.
TEST(HardCase, TheLargestAmountFalls) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    Volume v(Grid{9, 24, 9});
    put(v, 4, 20, 4, 65535, law == rule::Law::paper ? 65535 : 0);
    run::Simulation s = simulate(law == rule::Law::paper ? paper_showcase() : viscous(0.1), v);
    steps(s, 2000);
    EXPECT_EQ(state::holdings(s.volume()).liquid, 65535);
    EXPECT_LE(*std::max_element(s.volume().amount.stored().begin(), s.volume().amount.stored().end()), kOne);
    EXPECT_TRUE(s.drift().none());
  }
}

// A volume is all solid, all empty, or half and half. Nothing happens, in any implementation.
TEST(HardCase, SolidAndEmptyBlocksStayAsTheyAre) {
  for (const auto& implementation : run::implementations().all()) {
    if (!implementation.supported) continue;
    for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
      for (const int solid_until : {0, 64, 128}) {
        Parameters p = law == rule::Law::paper ? paper_showcase() : viscous(0.02);
        p.heat.enabled = true;
        p.heat.weight_face = 10922;
        Volume v(Grid{128, 16, 16});
        for_each({0, 0, 0, solid_until, 16, 16},
                 [&](int x, int y, int z) { put_solid(v, x, y, z, kOne, 20000); });
        run::Simulation s = simulate_with(implementation, p, v);
        steps(s, 20);
        EXPECT_EQ(state::digest(s.volume()), state::digest(v)) << implementation.name << ' ' << solid_until;
        EXPECT_EQ(s.volume().liquid.count(), 0);
      }
  }
}

// With sides of 1, 2, 63, 64 and 65 cells along each axis, every implementation gives the reference's bits.
TEST(HardCase, SidesOfOneTwoAndAroundAWord) {
  for (const int side : {1, 2, 63, 64, 65})
    for (const int axis : {0, 1, 2})
      for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
        Parameters p = law == rule::Law::paper ? paper_showcase() : viscous(0.1);
        p.heat.enabled = true;
        p.heat.neighbours = 26;
        p.heat.weight_face = 3000;
        p.heat.weight_edge = 1500;
        p.heat.weight_corner = 1000;
        p.material.melting_point = 30000;
        Volume v(Grid{axis == 0 ? side : 7, axis == 1 ? side : 7, axis == 2 ? side : 7});
        Random random(static_cast<std::uint64_t>(side));
        for_each(whole(v.grid), [&](int x, int y, int z) {
          const std::int32_t kind = random.below(5), amount = random.between(1, kOne);
          if (kind == 0) put_solid(v, x, y, z, amount, random.between(20000, 40000));
          if (kind > 2) put(v, x, y, z, amount, law == rule::Law::paper ? amount : 0, 35000);
        });
        std::uint64_t expected = 0;
        for (const auto& implementation : run::implementations().all()) {
          if (!implementation.supported) continue;
          run::Simulation s = simulate_with(implementation, p, v);
          steps(s, 12);
          EXPECT_TRUE(s.drift().none());
          const std::uint64_t digest = state::digest(s.volume());
          if (implementation.name == "reference") expected = digest;
          EXPECT_EQ(digest, expected) << implementation.name << ", side " << side << " on axis " << axis;
          EXPECT_NE(digest, state::digest(v)) << "nothing moved: the test would prove nothing";
        }
      }
}

}  // namespace
}  // namespace voxmelt::worlds
