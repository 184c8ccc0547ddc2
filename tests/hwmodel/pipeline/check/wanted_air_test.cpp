// A token that is called air must be air in every cell, or the checker would not look where a stage has lost
// what it held. The cells themselves come from wanted_cell, which reads one after another.
#include "hwmodel/pipeline/check/wanted_air.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <random>

#include "hwmodel/pipeline/check/wanted_cell.h"
#include "kernel/automaton/state/fields.h"

namespace voxmelt::hwmodel {
namespace {

class SparseWorld {
 public:
  SparseWorld(state::Grid grid, std::uint64_t seed)
      : random_(seed), volume_(std::make_shared<state::Volume>(grid)) {
    volume_->material = state::Field<std::uint8_t>(grid);
  }

  bool one_in(int n) { return random_() % n == 0; }

  // Sets each field alone, and in places where nothing else is, too. So each must count by itself.
  void fill() {
    const state::Grid grid = volume_->grid;
    for (int z = 0; z < grid.z; ++z)
      for (int y = 0; y < grid.y; ++y)
        for (int x = 0; x < grid.x; ++x)
          state::for_each_field([&](const auto& row) {
            if (one_in(300)) state::set_value((*volume_).*row.column, x, y, z, 1);
          });
  }

  Expected expected(bool with_bands) {
    const state::Grid grid = volume_->grid;
    Expected expected{volume_, volume_, {}};
    if (!with_bands) return expected;
    const auto pattern = std::make_shared<state::Field<std::uint8_t>>(grid);
    const auto set = std::make_shared<state::BitPlane>(grid);
    for (int z = 0; z < grid.z; ++z)
      for (int y = 0; y < grid.y; ++y)
        for (int x = 0; x < grid.x; ++x) {
          if (one_in(200)) (*pattern)[volume_->at(x, y, z)] = 16;
          if (one_in(200)) set->set(x, y, z, true);
        }
    expected.bands.pattern = pattern;
    expected.bands.set = set;
    const auto around = std::make_shared<const Surroundings>(*volume_);
    if (one_in(2)) expected.bands.axes = around;
    if (one_in(2)) expected.bands.touched = around;
    if (one_in(2)) expected.bands.sides = around;
    expected.bands.sides_of_blocked = one_in(2);
    return expected;
  }

 private:
  std::mt19937_64 random_;
  std::shared_ptr<state::Volume> volume_;
};

bool wants_only_air(const Expected& expected, const Shape& shape, const Place& place) {
  Cell empty;
  empty.amount = 0;
  empty.state = State::air;
  for (int x = place.x; x < place.x + shape.lanes; ++x)
    if (x >= shape.grid.x || !(wanted_cell(expected, x, place.y, place.z) == empty)) return false;
  return true;
}

TEST(WantedAir, IsAirInEveryCell) {
  std::int64_t air = 0, found = 0;
  std::uint64_t seed = 1;
  for (const state::Grid grid : {state::Grid{13, 7, 5}, state::Grid{70, 9, 4}, state::Grid{130, 5, 3}})
    for (const int lanes : {1, 2, 3, 4, 8, 32})
      for (int round = 0; round < 8; ++round) {
        SparseWorld world(grid, seed++);
        world.fill();
        const Expected expected = world.expected(round % 2 == 1);
        const Shape shape{grid, lanes};
        WantedAir wanted;
        Place place = begin_of(shape, 0);
        for (std::int64_t i = 0; i < shape.tokens(); ++i, place.next(shape)) {
          const bool is = wants_only_air(expected, shape, place), said = wanted.at(expected, shape, place);
          ASSERT_FALSE(said && !is) << grid.x << " wide, " << lanes << " lanes, " << place.x << ' ' << place.y
                                    << ' ' << place.z;
          air += is;
          found += said;
        }
      }
  EXPECT_GT(air, 20000);
  EXPECT_GT(found, air / 2);  // it looks at up to 8 cells at once
}

TEST(WantedAir, LooksAnewAtAnotherPlaneTileAndState) {
  const state::Grid grid{16, 2, 2};
  const auto empty = std::make_shared<state::Volume>(grid), full = std::make_shared<state::Volume>(grid);
  full->solid.set(0, 0, 1, true);
  full->solid.set(8, 0, 0, true);
  const Expected nothing{empty, empty, {}}, something{full, full, {}};
  const Shape shape{grid, 4, 2, 0};  // tiles of 8 cells
  WantedAir wanted;
  EXPECT_TRUE(wanted.at(nothing, shape, begin_of(shape, 0)));
  EXPECT_TRUE(wanted.at(something, shape, begin_of(shape, 0)));
  EXPECT_FALSE(wanted.at(something, shape, begin_of(shape, 1)));
  Place behind = begin_of(shape, 0);
  behind.z = 1;
  EXPECT_FALSE(wanted.at(something, shape, behind));
  EXPECT_TRUE(wanted.at(nothing, shape, behind));
}

}  // namespace
}  // namespace voxmelt::hwmodel
