// States are compared and copied. Every other comparison of states relies on these.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "kernel/automaton/state/fields.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::state {
namespace {

constexpr Grid kGrid{130, 20, 9};  // three words a row, several pages a field

Volume full_volume() {
  Volume volume(kGrid);
  int n = 0;
  worlds::for_each(worlds::whole(kGrid), [&](int x, int y, int z) {
    n = n % 60000 + 1;
    worlds::put(volume, x, y, z, n, n + 1, n + 2);
  });
  return volume;
}

TEST(Volume, AnyChangeOfAnyFieldOrMaskMakesItAnother) {
  const Volume base = full_volume();
  for (const auto& [x, y, z] : {std::array{0, 0, 0}, {63, 7, 3}, {64, 19, 8}, {129, 19, 8}}) {
    for_each_field([&](const auto& row) {
      if (row.optional) return;
      Volume other = base;
      EXPECT_TRUE(other == base);
      const std::uint32_t value = value_at(base.*row.column, x, y, z);
      set_value(other.*row.column, x, y, z, value ^ 1);
      EXPECT_FALSE(other == base) << row.name;
      EXPECT_FALSE(other.*row.column == base.*row.column) << row.name;
      set_value(other.*row.column, x, y, z, value);
      EXPECT_TRUE(other == base) << row.name;
    });
  }
  EXPECT_FALSE(Volume({3, 4, 5}) == Volume({3, 5, 4}));
}

TEST(Volume, ACopyHoldsEveryCellAndIsApart) {
  const Volume base = full_volume();
  Volume constructed = base, assigned(kGrid), resized({1, 1, 1});
  assigned = base;
  resized = base;
  for (const Volume* copy : {&constructed, &assigned, &resized})
    worlds::for_each(worlds::whole(kGrid), [&](int x, int y, int z) {
      const Slot cell = base.at(x, y, z);
      ASSERT_EQ(copy->amount[cell], base.amount[cell]);
      ASSERT_EQ(copy->energy[cell], base.energy[cell]);
      ASSERT_EQ(copy->heat[cell], base.heat[cell]);
      ASSERT_TRUE(copy->liquid.test(x, y, z));
    });
  constructed.amount.clear();
  EXPECT_EQ(constructed.amount[base.at(129, 19, 8)], 0);
  EXPECT_NE(base.amount[base.at(129, 19, 8)], 0);
}

}  // namespace
}  // namespace voxmelt::state
