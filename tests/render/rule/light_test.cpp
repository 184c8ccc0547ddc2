// The rule of light is tested by hand, and against double.
#include "render/rule/light_grid.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace voxmelt::picture {
namespace {

TEST(LightGrid, CellsOfLightByHand) {
  EXPECT_EQ(light_shift({1, 1, 1}), 1);
  EXPECT_EQ(light_shift({128, 256, 128}), 1);  // 2^22 cells are the most for two cells a side
  EXPECT_EQ(light_shift({128, 257, 128}), 2);
  EXPECT_EQ(light_shift({1024, 1024, 1024}), 4);  // 2^30 of up to 2^31
  EXPECT_EQ(light_cells({107, 128, 1}), (Vector{54, 64, 1}));
}

TEST(LightGrid, LossByHand) {
  EXPECT_EQ(loss_of(0), 0);
  EXPECT_EQ(loss_of(12), 0);
  EXPECT_EQ(loss_of(13), 1);  // 1.5
  EXPECT_EQ(loss_of(112), 150);
  EXPECT_EQ(loss_of(182), 255);
  EXPECT_EQ(loss_of(183), 256);  // 256.5
  EXPECT_EQ(loss_of(255), 256);
  EXPECT_EQ(passed(255, 0), 255);
  EXPECT_EQ(passed(255, 256), 0);
  EXPECT_EQ(passed(255, 128), 128);  // 127.5, to nearest
  EXPECT_EQ(passed(3, 192), 1);      // 0.75
  EXPECT_EQ(glowing(200, 0, 100), 255);
  EXPECT_EQ(glowing(200, 128, 20), 120);
}

// A slope of -0.6 (-9830 / 16384) is -1.79993 cells at slice 3, which is -2 and 51 of 256.
TEST(LightGrid, ShiftsByHand) {
  EXPECT_EQ(shift_at(0, -9830).cells, 0);
  EXPECT_EQ(shift_at(3, -9830).cells, -2);
  EXPECT_EQ(shift_at(3, -9830).part, 51);
  EXPECT_EQ(shift_at(7, 16384).cells, 7);
  EXPECT_EQ(shift_at(7, 16384).part, 0);
}

TEST(LightGrid, FiltersByHand) {
  EXPECT_EQ(softer(255, 255, 255), 255);
  EXPECT_EQ(softer(0, 255, 0), 239);  // 239.06
  EXPECT_EQ(softer(255, 0, 0), 8);    // 7.97
  EXPECT_EQ(spread({255, 255, 255, 255, 255}), 255);
  EXPECT_EQ(spread({0, 0, 100, 0, 0}), 25);
  EXPECT_EQ(spread({100, 0, 0, 0, 0}), 13);  // 12.5, halves upwards
  EXPECT_EQ(opened(255), 255);
  EXPECT_EQ(opened(254), 255);  // the least way is gone in one slice
  EXPECT_EQ(opened(0), 32);     // 255 / 8, rounded up
  EXPECT_EQ(faded(255), 239);   // less 16
  EXPECT_EQ(faded(7), 7);
}

// An even light stays even, however often it is swept.
TEST(LightGrid, EvenLightStays) {
  for (std::int32_t light = 0; light < 256; ++light) {
    EXPECT_EQ(softer(light, light, light), light);
    EXPECT_EQ(spread({light, light, light, light, light}), light);
    EXPECT_EQ(passed(light, 0), light);
  }
}

TEST(LightGrid, SidesSeenAlongADirection) {
  const std::array<std::int32_t, kSides> sides{10, 20, 30, 40, 50, 60};
  EXPECT_EQ(seen_along(sides, {16384, 0, 0}), 10);
  EXPECT_EQ(seen_along(sides, {-16384, 0, 0}), 20);
  EXPECT_EQ(seen_along(sides, {0, 16384, 0}), 30);
  EXPECT_EQ(seen_along(sides, {0, -16384, 0}), 40);
  EXPECT_EQ(seen_along(sides, {0, 0, 16384}), 50);
  EXPECT_EQ(seen_along(sides, {0, 0, -16384}), 60);
  // The direction is 3 4 0 of 5. The shares are 9 and 16 of 25, so 10 x 0.36 + 40 x 0.64 = 29.2.
  EXPECT_EQ(seen_along(sides, {9830, -13107, 0}), 29);
}

// Two cells of light lie along x. They are two cells wide, so their middles are at 1 and 3 cells.
TEST(LightGrid, BetweenCellsOfLight) {
  const auto lights = [](std::int64_t x, std::int64_t, std::int64_t) {
    Light light;
    light.lamp = x == 0 ? 0 : 200;
    light.open[3] = x == 0 ? 100 : 0;
    return light;
  };
  const auto at = [&](std::int64_t x) { return light_at(lights, {2, 1, 1}, 1, {x, 0, 0}); };
  EXPECT_EQ(at(kCell).lamp, 0);
  EXPECT_EQ(at(2 * kCell).lamp, 100);
  EXPECT_EQ(at(2 * kCell).open[3], 50);
  EXPECT_EQ(at(3 * kCell).lamp, 200);
  EXPECT_EQ(at(-9 * kCell).lamp, 0);  // the nearest repeats itself
  EXPECT_EQ(at(99 * kCell).lamp, 200);
  EXPECT_EQ(before_surface({0, 0, 0}, {0, 16384, 0}, 1), (Vector{0, 2 * kCell, 0}));
}

}  // namespace
}  // namespace voxmelt::picture
