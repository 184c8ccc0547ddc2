#include "hwmodel/lockstep/shrink.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace voxmelt::hwmodel {
namespace {

using Cell3 = std::array<int, 3>;

state::Volume filled(state::Grid grid) {
  state::Volume volume(grid);
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x) {
        volume.liquid.set(x, y, z, true);
        volume.amount[volume.at(x, y, z)] = static_cast<std::uint16_t>(1 + x + 100 * y + 10000 * (z % 3));
      }
  return volume;
}

// Does a case still hold this cell of the scene, as it was?
bool holds(const Case& one, const state::Volume& scene, const Cell3& cell) {
  const int x = cell[0] - one.from[0], y = cell[1] - one.from[1], z = cell[2] - one.from[2];
  return one.volume.grid.contains(x, y, z) && one.volume.liquid.test(x, y, z) &&
         one.volume.amount[one.volume.at(x, y, z)] == scene.amount[scene.at(cell[0], cell[1], cell[2])];
}

int liquid(const Case& one) {
  int cells = 0;
  for (int z = 0; z < one.volume.grid.z; ++z)
    for (int y = 0; y < one.volume.grid.y; ++y)
      for (int x = 0; x < one.volume.grid.x; ++x) cells += one.volume.liquid.test(x, y, z);
  return cells;
}

// It fails while two cells are there, the machine has four lanes, and "vent.1" pours.
TEST(Shrinker, KeepsWhatTheFailureNeedsAndNothingElse) {
  const state::Volume scene = filled({27, 20, 22});
  const Cell3 a{20, 3, 11}, b{16, 8, 11};
  Case begin{scene, {}, 40, 5, {}, {}};
  begin.configuration = {.lanes = 16, .cascade = 3, .fifo_depth = 9, .stall_seed = 5, .substeps = 2};
  int asked = 0;
  Shrinker shrinker(
      begin, {"vent.0", "vent.1"},
      [&](const Case& one) {
        ++asked;
        return holds(one, scene, a) && holds(one, scene, b) && one.configuration.lanes >= 4 &&
               one.without != std::vector<std::string>{"vent.1"} && one.without.size() < 2;
      },
      [] { return true; });
  const Case& small = shrinker.shrink(a);
  EXPECT_EQ(small.size(), (Cell3{5, 6, 1}));
  EXPECT_EQ(small.from, (Cell3{16, 3, 11}));
  EXPECT_EQ(liquid(small), 2);
  EXPECT_EQ(small.steps, 1u);
  EXPECT_EQ(small.first_step, 40u);
  EXPECT_EQ(small.configuration.lanes, 4);
  EXPECT_EQ(small.configuration.cascade, 1);
  EXPECT_EQ(small.configuration.substeps, 1);
  EXPECT_EQ(small.configuration.stall_seed, 0u);
  EXPECT_EQ(small.configuration.fifo_depth, Configuration{}.fifo_depth);
  EXPECT_EQ(small.without, std::vector<std::string>{"vent.0"});
  EXPECT_EQ(shrinker.tried(), asked);
}

TEST(Shrinker, LeavesWhatCannotBeMadeSmaller) {
  Case begin{filled({5, 4, 3}), {}, 0, 1, {}, {}};
  begin.configuration.lanes = 1;
  Shrinker shrinker(
      begin, {"vent.0"}, [](const Case&) { return false; }, [] { return true; });
  const Case& small = shrinker.shrink({1, 1, 1});
  EXPECT_EQ(small.volume, begin.volume);
  EXPECT_EQ(small.steps, 1u);
  EXPECT_TRUE(small.without.empty());
}

TEST(Shrinker, EndsWhenItsTimeIsOver) {
  int left = 3;
  Shrinker shrinker(
      {filled({16, 16, 16}), {}, 0, 4, {}, {}}, {}, [](const Case&) { return true; },
      [&] { return left-- > 0; });
  shrinker.shrink({8, 8, 8});
  EXPECT_EQ(shrinker.tried(), 3);
}

}  // namespace
}  // namespace voxmelt::hwmodel
