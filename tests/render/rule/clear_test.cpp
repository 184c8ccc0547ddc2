// The light that clear matter lets through is tested by hand, and against double.
#include "render/rule/clear.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "render/rule/shade.h"

namespace voxmelt::picture {
namespace {

TEST(Clear, WhatPassesIsThatOfDouble) {
  const Passing table = passing_table();
  EXPECT_EQ(table[0], 32768);
  EXPECT_EQ(table[256], 16384);
  EXPECT_EQ(table[1024], 2048);
  for (std::size_t i = 0; i < 2047; ++i)
    EXPECT_NEAR(table[i], 32768 * std::exp2(-static_cast<double>(i) / 256), 0.51) << i;
  EXPECT_EQ(table[2046], 129);  // 128.7
  EXPECT_EQ(table[2047], 0);
}

TEST(Clear, LossesByHand) {
  EXPECT_EQ(losses_of({64, 128, 16384}), (Color{4096, 2048, 16}));  // 1, 2 and 256 cells
  EXPECT_EQ(losses_of({640, 0, 1}), (Color{409, 4096, 4096}));      // 409.6; less than a cell counts as one
  EXPECT_TRUE(is_clear({.clear = {0, 0, 1}}));
  EXPECT_FALSE(is_clear({.clear = {0, 0, 0}}));
  EXPECT_FALSE(is_clear({.clear = {64, 64, 64}, .glow = true}));
}

// Ten cells of matter let half of the red pass, and the way is ten cells long. (2560 x 409) >> 12 = 255, and
// 2^15 2^(-255/256) is 16428.4. For green, 2560 entries are more than the table has. For blue, (2560 x 16) >>
// 12 = 10 gives 31892.8.
TEST(Clear, PassedByHand) {
  const Passing table = passing_table();
  const Color losses{409, 4096, 16};
  EXPECT_EQ(passed(table, losses, {}), (Color{32768, 32768, 32768}));
  EXPECT_EQ(passed(table, losses, {kLight, 10 << 16}), (Color{16428, 0, 31893}));
  EXPECT_EQ(passed(table, losses, {kLight / 2, 10 << 16}), (Color{8214, 0, 15946}));
  EXPECT_EQ(passed(table, losses, {0, 0}), (Color{0, 0, 0}));
  // The longest way of all has (2^19 - 1) x 16 >> 12 = 2047.
  EXPECT_EQ(passed(table, {16, 16, 16}, {kLight, kMostWay}), (Color{0, 0, 0}));
}

TEST(Clear, SurfacesAndWaysByHand) {
  EXPECT_EQ(dimmed(4096, 0), 4096);
  EXPECT_EQ(dimmed(4096, 1024), 3072);
  EXPECT_EQ(dimmed(3000, 1), 2999);  // 2999.3
  EXPECT_EQ(dimmed(3000, 4096), 0);
  EXPECT_EQ(further(5, 7), 12);
  EXPECT_EQ(further(kMostWay - 5, 7), kMostWay);
  EXPECT_EQ(length_of_step({-262144, 0, 0}, {16384, 0, 0}), 16384);  // a quarter of 65536
  EXPECT_EQ(length_of_step({0, 131077, 0}, {0, -16384, 0}), 8193);   // 8192.3, away from the eye
  // 3 x 16384 x 9459 / 16384 is 28377, and a quarter of the root of 3 is 28377.9.
  EXPECT_EQ(length_of_step({262144, -262144, 262144}, {-9459, 9459, -9459}), 28377);
}

// The light halves in 16 cells, and a cell of light is two wide. Entry 512 x 256 / 4096 = 32 is 2^15 2^(-1/8)
// = 30048.4, and 234 of 256 pass. Then 180 x 22 / 256 is 15.5.
TEST(Clear, DensityForLightByHand) {
  const Passing table = passing_table();
  EXPECT_EQ(density_share(table, {1, 256, 1}, 1), 15);
  EXPECT_EQ(density_share(table, {1, 4096, 1}, 4), 180);  // nothing passes
  EXPECT_EQ(thinned(12, 15), 12);
  EXPECT_EQ(thinned(255, 15), 26);  // 12 + 14.2
  EXPECT_EQ(loss_of(26), 21);       // wanted are 22
  EXPECT_EQ(thinned(100, 15), 17);  // 12 + 5.2
  EXPECT_EQ(thinned(200, 256), 200);
}

// In the open every side gives half of the sky and half of the ground: (1530 x 43) >> 9 = 128.
TEST(Clear, InnerLightByHand) {
  const Color lamp{1000, 2000, 0}, below{100, 0, 0}, above{300, 0, 4000};
  EXPECT_EQ(inner_light(lamp, below, above, Light{}), (Color{200 + 500, 1000, 2000}));
  Light light;
  light.lamp = 127;
  light.open = {0, 0, 255, 0, 0, 0};  // from above alone: 510 x 43 / 512 = 42.8
  EXPECT_EQ(inner_light(lamp, below, above, light), (Color{(300 * 42 >> 8) + 248, 496, (4000 * 42) >> 8}));
  light.lamp = 0;
  light.open = {0, 0, 0, 100, 0, 0};  // from below: 16.8
  EXPECT_EQ(inner_light(lamp, below, above, light), (Color{6, 0, 0}));
  light.open = {0, 100, 0, 0, 0, 0};  // from a side: 8.4 of both
  EXPECT_EQ(inner_light(lamp, below, above, light), (Color{(400 * 8) >> 8, 0, (4000 * 8) >> 8}));
}

// Seen from within, a surface mirrors the scene in front of it, and scatters the light that arrives behind.
TEST(Clear, ASurfaceFromWithin) {
  Look look;
  look.solid = {4096, 4096, 4096};
  const Paint paint = paint_of(look, {{0, 1, 0}, 0});  // the lamp above, no other light
  const Vector up{0, 16384, 0}, down{0, -16384, 0};
  const auto scattered = [&](Vector normal, Vector out) {
    return shine_of(paint, normal, out, down, Light{}, {}).scattered[1];
  };
  EXPECT_NEAR(scattered(down, up), 4915, 2);  // 1.2: the lamp lights the far side
  EXPECT_EQ(scattered(down, down), 0);
}

}  // namespace
}  // namespace voxmelt::picture
