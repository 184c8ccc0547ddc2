// Curves of several materials are held against values by hand (docs/automaton.md, sections 6 and 7).
#include "kernel/automaton/rule/materials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

namespace voxmelt::rule {
namespace {

// The first melts at 20000 and takes 5000 to do so. The second takes half as much more heat for a degree:
// warmth 43690 is 65536 / 1.5, rounded down.
Parameters two_materials() {
  Parameters p;
  p.material = {.melting_point = 20000, .latent_heat = 5000};
  p.materials = {{.melting_point = 20000, .latent_heat = 5000},
                 {.melting_point = 30000, .latent_heat = 1000, .warmth = 43690}};
  return p;
}

TEST(Materials, OneIsAsTheSceneSays) {
  Parameters p;
  p.material = {.melting_point = 20000, .latent_heat = 5000};
  const Materials materials(p);
  for (std::int32_t h = 0; h <= 65535; ++h) {
    ASSERT_EQ(materials.temperature(h, 0), temperature_of(h, p.material));
    ASSERT_EQ(materials.melts(h, 0), h >= 25000);
    ASSERT_EQ(materials.melted(h, 0), h);
  }
}

TEST(Materials, WarmthAndLatentHeatByHand) {
  const Materials materials(two_materials());
  EXPECT_EQ(materials.temperature(1000, 1), 666) << "1000 x 43690 = 43690000, over 65536: 666.66";
  // 45001 x 43690 >> 16 = 30000, and 45000 x 43690 >> 16 = 29999. So S is 45001, and F 46001.
  EXPECT_EQ(materials.temperature(45000, 1), 29999);
  EXPECT_EQ(materials.temperature(45001, 1), 30000);
  EXPECT_EQ(materials.temperature(46001, 1), 30000);
  EXPECT_EQ(materials.temperature(46002, 1), 30001);
  EXPECT_EQ(materials.liquid_from(1), 46001);
  EXPECT_FALSE(materials.melts(46000, 1));
  EXPECT_TRUE(materials.melts(46001, 1));
}

// At h = 65535 the first has 60535, the second min(65535 x 43690 >> 16, 65535 - 16001) = min(43689, 49534).
TEST(Materials, NoneIsHotterThanTheColdestOfTheHottest) {
  const Materials materials(two_materials());
  EXPECT_EQ(materials.temperature(65535, 1), 43689);
  EXPECT_EQ(materials.temperature(65535, 0), 43689);
  EXPECT_EQ(materials.temperature(48689, 0), 43689);
  EXPECT_EQ(materials.temperature(48688, 0), 43688);
}

// 30000 is above the first's melting point. So liquid has 5000 more than that there.
TEST(Materials, WhatMeltsKeepsItsTemperature) {
  const Materials materials(two_materials());
  EXPECT_EQ(materials.melted(46001, 1), 35000);
  EXPECT_EQ(materials.temperature(35000, 0), 30000);
  EXPECT_EQ(materials.melted(46101, 1), 35100);
  Parameters low = two_materials();
  low.materials[1] = {.melting_point = 10000, .latent_heat = 40000};
  EXPECT_EQ(Materials(low).melted(50007, 1), 10007) << "below the first's melting point h is the temperature";
}

TEST(Materials, HeatIsCutAtTheTop) {
  Parameters p = two_materials();
  p.materials[0].latent_heat = p.material.latent_heat = 40000;
  p.materials[1] = {.melting_point = 21000, .latent_heat = 100};
  EXPECT_EQ(Materials(p).melted(21100, 1), 61000);
  EXPECT_EQ(Materials(p).melted(30000, 1), 65535) << "8900 more would be 69900";
}

// The bounds of docs/proofs.md: no cell gives more than it has, or gets more than there is room for.
TEST(Materials, TemperatureIsNoMoreThanHeatAndGrowsNoFaster) {
  for (const std::uint32_t warmth : {4096u, 30000u, 43690u, 65535u, 65536u}) {
    Parameters p = two_materials();
    p.materials[1] = {.melting_point = 3000, .latent_heat = 700, .warmth = warmth};
    const Materials materials(p);
    const std::int32_t top = std::min(materials.temperature(65535, 0), materials.temperature(65535, 1));
    for (std::int32_t h = 0; h <= 65535; ++h)
      for (const int m : {0, 1}) {
        const std::int32_t t = materials.temperature(h, m);
        ASSERT_LE(t, h);
        ASSERT_LE(t, top);
        if (h == 65535) continue;
        const std::int32_t rise = materials.temperature(h + 1, m) - t;
        ASSERT_TRUE(rise == 0 || rise == 1) << h;
      }
  }
}

}  // namespace
}  // namespace voxmelt::rule
