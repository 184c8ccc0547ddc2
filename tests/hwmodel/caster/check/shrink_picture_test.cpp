// A picture that fails is made small while it still fails. Each test defines what "fails" means.
#include "hwmodel/caster/check/shrink_picture.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace voxmelt::hwmodel::raycast {
namespace {

using Cell3 = std::array<int, 3>;

state::Volume filled(state::Grid grid) {
  state::Volume volume(grid);
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x) volume.solid.set(x, y, z, true);
  return volume;
}

PictureCase whole_case() {
  PictureCase one{filled({20, 17, 12}), {}, {0, 0, 40, 30}, render::Setting::best, {}, {}};
  one.configuration.pipes = 4;
  one.configuration.fifo_depth = 2;
  one.configuration.stall_seed = 7;
  return one;
}

// Tells whether a case still holds this cell of the scene.
bool holds(const PictureCase& one, const Cell3& cell) {
  const int x = cell[0] - one.from[0], y = cell[1] - one.from[1], z = cell[2] - one.from[2];
  return one.volume.grid.contains(x, y, z) && one.volume.solid.test(x, y, z);
}

int solid(const PictureCase& one) {
  int cells = 0;
  for (int z = 0; z < one.volume.grid.z; ++z)
    for (int y = 0; y < one.volume.grid.y; ++y)
      for (int x = 0; x < one.volume.grid.x; ++x) cells += one.volume.solid.test(x, y, z);
  return cells;
}

// The failure needs two cells, pixel (23, 11), channels of depth 2, and more than one sample a pixel.
TEST(PictureShrinker, KeepsWhatTheFailureNeedsAndNothingElse) {
  const Cell3 a{4, 5, 6}, b{9, 5, 7};
  int asked = 0;
  PictureShrinker shrinker(
      whole_case(),
      [&](const PictureCase& one) {
        ++asked;
        return holds(one, a) && holds(one, b) && one.window.holds(23, 11) &&
               one.configuration.fifo_depth == 2 && one.setting != render::Setting::fast &&
               one.without.empty();
      },
      [] { return true; });
  const PictureCase& small = shrinker.shrink(a);
  EXPECT_EQ(small.from, a);
  EXPECT_EQ(small.volume.grid, (state::Grid{6, 1, 2}));
  EXPECT_EQ(solid(small), 2);
  EXPECT_EQ((std::array{small.window.left, small.window.top, small.window.right, small.window.bottom}),
            (std::array<std::int32_t, 4>{23, 11, 24, 12}));
  EXPECT_EQ(small.pixels(), 1);
  EXPECT_EQ(small.setting, render::Setting::normal);
  EXPECT_EQ(small.configuration.pipes, 1);
  EXPECT_EQ(small.configuration.stall_seed, 0u);
  EXPECT_EQ(small.configuration.fifo_depth, 2);
  EXPECT_TRUE(small.without.empty());
  EXPECT_EQ(shrinker.tried(), asked);
}

// A tile that lies across the middle of the picture can only be cut from outside.
TEST(PictureShrinker, KeepsAPartThatLiesInNoHalf) {
  PictureShrinker shrinker(
      whole_case(),
      [](const PictureCase& one) { return one.window.holds(19, 14) && one.window.holds(20, 15); },
      [] { return true; });
  const PictureCase& small = shrinker.shrink({});
  EXPECT_EQ((std::array{small.window.left, small.window.top, small.window.right, small.window.bottom}),
            (std::array<std::int32_t, 4>{19, 14, 21, 16}));
  EXPECT_EQ(small.without, std::vector<std::string>{"terrain"});
}

TEST(PictureShrinker, LeavesWhatCannotBeMadeSmaller) {
  const PictureCase begin = whole_case();
  PictureShrinker shrinker(
      begin, [](const PictureCase&) { return false; }, [] { return true; });
  const PictureCase& small = shrinker.shrink(Cell3{1, 1, 1});
  EXPECT_EQ(small.volume, begin.volume);
  EXPECT_EQ(small.pixels(), 1200);
  EXPECT_EQ(small.configuration.pipes, 4);
  EXPECT_EQ(small.setting, render::Setting::best);
}

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
