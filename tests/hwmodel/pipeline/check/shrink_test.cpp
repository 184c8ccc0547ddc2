#include "hwmodel/pipeline/check/shrink.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>
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

// Tells whether a case still holds this cell of the scene, with its old amount.
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

// The failure needs two cells, a machine of four lanes or more, and "vent.1".
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

// Makes a volume with one cell of every kind, with all that it can hold, at the corners of a box.
state::Volume of_every_kind() {
  state::Volume volume(state::Grid{6, 5, 4});
  volume.solid.set(1, 1, 1, true);
  volume.inert.set(3, 2, 1, true);
  volume.liquid.set(3, 1, 2, true);
  const auto put = [&](int x, int y, int z, std::uint16_t amount, std::uint16_t energy, std::uint16_t heat) {
    const state::Slot at = volume.at(x, y, z);
    volume.amount[at] = amount;
    volume.energy[at] = energy;
    volume.heat[at] = heat;
  };
  put(1, 1, 1, 4000, 0, 500);
  put(3, 2, 1, 2048, 0, 700);
  put(3, 1, 2, 900, 300, 40000);
  return volume;
}

TEST(Shrinker, APartHoldsAllThatItsCellsHold) {
  const state::Volume whole = of_every_kind(), part = state::part_of(whole, {{1, 1, 1}, {3, 2, 2}});
  EXPECT_EQ(part.grid, (state::Grid{3, 2, 2}));
  EXPECT_TRUE(part.solid.test(0, 0, 0) && part.inert.test(2, 1, 0) && part.liquid.test(2, 0, 1));
  const auto all_of = [&](int x, int y, int z) {
    const state::Slot at = part.at(x, y, z);
    return Cell3{part.amount[at], part.energy[at], part.heat[at]};
  };
  EXPECT_EQ(all_of(0, 0, 0), (Cell3{4000, 0, 500}));
  EXPECT_EQ(all_of(2, 1, 0), (Cell3{2048, 0, 700}));
  EXPECT_EQ(all_of(2, 0, 1), (Cell3{900, 300, 40000}));
  EXPECT_FALSE(part.liquid.test(0, 0, 0) || part.solid.test(1, 1, 1) || part.inert.test(0, 0, 1));
}

// The failure needs the whole grid, so nothing can be cut off. Then all matter can go.
TEST(Shrinker, MatterOfEveryKindIsTakenAway) {
  const state::Volume whole = of_every_kind();
  Shrinker shrinker(
      {whole, {}, 0, 1, {}, {}}, {}, [&](const Case& one) { return one.volume.grid == whole.grid; },
      [] { return true; });
  EXPECT_EQ(shrinker.shrink({3, 1, 2}).volume, state::Volume(whole.grid));
}

// The first part that is tried has the cell of the first difference in its middle.
TEST(Shrinker, BeginsAroundTheFirstDifference) {
  std::vector<std::pair<Cell3, Cell3>> parts;
  Shrinker shrinker(
      {state::Volume(state::Grid{40, 40, 40}), {}, 0, 1, {}, {}}, {},
      [&](const Case& one) {
        parts.emplace_back(one.from, one.size());
        return one.from != Cell3{};
      },
      [] { return true; });
  shrinker.shrink({20, 30, 25});
  ASSERT_FALSE(parts.empty());
  EXPECT_EQ(parts.front(), (std::pair{Cell3{16, 26, 21}, Cell3{8, 8, 8}}));
}

// While the vent is there, the failure needs the whole grid. Without it, any grid fails.
TEST(Shrinker, CutsAgainWhereSourcesAreGone) {
  const state::Volume whole = filled({9, 9, 9});
  Shrinker shrinker(
      {whole, {}, 0, 1, {}, {}}, {"vent.0"},
      [&](const Case& one) { return !one.without.empty() || one.volume.grid == whole.grid; },
      [] { return true; });
  EXPECT_EQ(shrinker.shrink({4, 4, 4}).size(), (Cell3{1, 1, 1}));
}

TEST(Shrinker, MakesTwoStepsOne) {
  Shrinker shrinker(
      {filled({3, 3, 3}), {}, 7, 2, {}, {}}, {}, [](const Case&) { return true; }, [] { return true; });
  const Case& small = shrinker.shrink({1, 1, 1});
  EXPECT_EQ(small.steps, 1u);
  EXPECT_EQ(small.first_step, 7u);
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
