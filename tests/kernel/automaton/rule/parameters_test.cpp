// Some values follow from the parameters alone: steps of visibility, sides of falling cells, bounds of
// spreading.
#include "kernel/automaton/rule/parameters.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace voxmelt::rule {
namespace {

Heat radiating_every(std::uint32_t steps) {
  Heat heat;
  heat.enabled = heat.radiation = true;
  heat.visibility_every = steps;
  return heat;
}

TEST(Visibility, FallsOnMultiplesOfItsInterval) {
  const Heat heat = radiating_every(3);
  std::vector<std::uint32_t> found, ages;
  for (std::uint32_t step = 0; step < 8; ++step) {
    if (heat.is_visibility_step(step)) found.push_back(step);
    ages.push_back(heat.visibility_age(step));
  }
  EXPECT_EQ(found, (std::vector<std::uint32_t>{0, 3, 6}));
  EXPECT_EQ(ages, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 2, 0, 1}));
  EXPECT_EQ(heat.visibility_age(0xFFFFFFFFu), 0u);  // 2^32 - 1 = 3 x 1431655765
  EXPECT_TRUE(radiating_every(1).is_visibility_step(7));
}

TEST(Visibility, IsNeverWithoutRadiationOrHeat) {
  Heat cold = radiating_every(3), dark = cold;
  cold.enabled = dark.radiation = false;
  for (const Heat& heat : {cold, dark})
    for (const std::uint32_t step : {0u, 1u, 2u, 3u}) {
      EXPECT_FALSE(heat.radiates());
      EXPECT_FALSE(heat.is_visibility_step(step));
      EXPECT_EQ(heat.visibility_age(step), 0u);
    }
}

TEST(Falling, SeesItsSidesWhereWallsHoldOrDropsHang) {
  EXPECT_FALSE(Fall{}.sees_sides());
  EXPECT_FALSE((Fall{.factor = 9, .wall_factor = 9}.sees_sides()));
  EXPECT_TRUE((Fall{.factor = 9, .wall_factor = 8}.sees_sides()));
  EXPECT_TRUE(Fall{.hang = 1}.sees_sides());
}

TEST(Falling, IsFreeWhereEverythingFallsWhole) {
  EXPECT_TRUE(Fall{}.is_free());
  EXPECT_TRUE(Fall{.minimum = 0}.is_free());
  EXPECT_FALSE((Fall{.factor = 65535, .wall_factor = 65535}.is_free()));
  EXPECT_FALSE((Fall{.factor = 65535, .wall_factor = 65536}.is_free()));
  EXPECT_FALSE(Fall{.wall_factor = 65535}.is_free());
  EXPECT_FALSE(Fall{.hang = 1}.is_free());
}

// The values are those of docs/automaton.md, sections 9 and 14.
TEST(Spreading, HasThePagesBounds) {
  EXPECT_EQ(largest_share(8), 13107);
  EXPECT_EQ(largest_share(4), 16384);
  EXPECT_EQ(flow_cap(8), 4096);
  EXPECT_EQ(flow_cap(4), 8192);
  EXPECT_EQ(receiver_limit(8), 45056);
  EXPECT_EQ(receiver_limit(4), 32768);
}

}  // namespace
}  // namespace voxmelt::rule
