// Smoothing has two strengths, for liquid and for solid, and leaves puddles without terraces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

#include "render/density/density_field.h"
#include "render/density/levels.h"
#include "render/density/low_pass.h"
#include "tests/render/shapes.h"
#include "tests/render/sight.h"

namespace voxmelt {
namespace {

using render::DensityField;
using test::Sight;

DensityField field_of(const state::Volume& volume, int liquid, int solid) {
  scene::Look look;
  look.smooth = liquid;
  look.smooth_solid = solid;
  DensityField field;
  field.update(volume, look);
  return field;
}

void film(state::Volume& volume, int x, int y, int z, double amount) {
  if (volume.solid.test(x, y, z) || volume.inert.test(x, y, z)) return;
  volume.liquid.set(x, y, z, true);
  volume.amount[volume.at(x, y, z)] = static_cast<std::uint16_t>(amount * rule::kOne);
}

TEST(Smooth, DrySolidGetsItsOwnPasses) {
  state::Volume volume(state::Grid{40, 40, 40});
  test::ball(volume, 20, 19, 21, 9);
  const auto cells = render::cell_fields(volume).intensity;
  for (const int solid : {0, 1, 4})
    EXPECT_TRUE(field_of(volume, 3, solid).intensity() == render::low_pass(volume.grid, solid, cells))
        << solid;
}

TEST(Smooth, LiquidGetsItsOwnPasses) {
  const state::Grid grid{40, 40, 40};
  state::Volume volume(grid);
  test::ball(volume, 20, 19, 21, 9);
  std::swap(volume.solid, volume.liquid);
  const auto cells = render::cell_fields(volume).intensity;
  for (const int liquid : {0, 3, 6})
    EXPECT_TRUE(field_of(volume, liquid, 1).intensity() == render::low_pass(grid, liquid, cells)) << liquid;
}

// A rod as thin as a peg disappears under the liquid's filter. Under the solid's filter it stays, with or
// without a film.
TEST(Smooth, ThinSolidSurvivesUnderAFilm) {
  const state::Grid grid{40, 40, 40};
  for (const double amount : {0.0, 0.2, 0.45}) {
    state::Volume volume(grid);
    for (int x = 4; x < 36; ++x)
      for (int y = 19; y < 22; ++y)
        for (int z = 19; z < 22; ++z) {
          volume.solid.set(x, y, z, true);
          volume.amount[volume.at(x, y, z)] = rule::kOne;
        }
    if (amount > 0)
      for (int x = 4; x < 36; ++x)
        for (int z = 19; z < 22; ++z) film(volume, x, 22, z, amount);
    const auto rod_height = [&](int liquid, int solid) {
      const DensityField field = field_of(volume, liquid, solid);
      return Sight(field).height(20.3, 20.5);
    };
    const double kept = rod_height(6, 1);
    const double blurred = rod_height(6, 6);
    const double sharp = rod_height(1, 1);
    EXPECT_GT(kept, 21.5) << amount;
    EXPECT_NEAR(kept, sharp, 0.12) << amount;
    EXPECT_LT(blurred, kept - 0.3) << amount;
  }
}

// From a film of nothing to a deep layer on a solid slab, the surface rises as the layer does. There is no
// seam.
TEST(Smooth, SurfaceRisesWithTheLayerOnASolid) {
  const state::Grid grid{72, 24, 24};
  state::Volume volume(grid);
  const auto depth = [](double x) { return std::max(0.0, (x - 10) * 0.08); };
  for (int z = 0; z < grid.z; ++z)
    for (int x = 0; x < grid.x; ++x) {
      for (int y = 0; y < 8; ++y) {
        volume.solid.set(x, y, z, true);
        volume.amount[volume.at(x, y, z)] = rule::kOne;
      }
      for (int y = 8; depth(x + 0.5) > y - 8; ++y)
        film(volume, x, y, z, std::min(1.0, depth(x + 0.5) - (y - 8)));
    }
  const DensityField field = field_of(volume, 6, 1);
  const Sight sight(field);
  for (double x = 16; x < 64; x += 0.31) EXPECT_NEAR(sight.height(x, 12.1), 8 + depth(x), 0.2) << x;
}

// The level is 6 + x / period. Each terrace of so many columns is up to `wave` too high and too low.
render::PuddleLevels terraced_slope(int side, double wave, int period = 4) {
  render::PuddleLevels levels{side, side, {}, {}};
  for (int z = 0; z < side; ++z)
    for (int x = 0; x < side; ++x) {
      const double height = 6 + 1.0 * x / period + wave * std::sin(2 * std::numbers::pi * x / period + 0.5);
      levels.depth.push_back(static_cast<std::int32_t>(std::lround(height * rule::kOne)));
      levels.level.push_back(levels.depth.back() + 2 * rule::kOne);
    }
  return levels;
}

TEST(Levels, EvenSlopesStay) {
  for (const std::int32_t shift : render::level_shifts(terraced_slope(24, 0), 24))
    EXPECT_LE(std::abs(shift), 1);
}

TEST(Levels, ShiftsAreSmallAndDrySpotsAndCliffsStay) {
  render::PuddleLevels levels = terraced_slope(24, 0);
  const auto at = [](int x, int z) { return static_cast<std::size_t>(z * 24 + x); };
  levels.level[at(5, 5)] = render::kNoLevel;
  levels.level[at(12, 12)] += 3 * rule::kOne;  // falling liquid, so no puddle
  levels.level[at(18, 6)] += rule::kOne;       // a drop
  levels.level[at(18, 18)] += rule::kOne;      // a drop again, but the layer is thin
  levels.depth[at(18, 18)] = rule::kOne / 10;
  const auto shifts = render::level_shifts(levels, 24);
  EXPECT_EQ(shifts[at(5, 5)], 0);
  EXPECT_LE(std::abs(shifts[at(12, 12)]), 2);
  EXPECT_EQ(shifts[at(18, 6)], -rule::kOne / 4);
  EXPECT_EQ(shifts[at(18, 18)], -rule::kOne / 20);
  EXPECT_LE(std::abs(shifts[at(11, 12)]), 2) << "beside the falling liquid";
}

TEST(Levels, TerracesGo) {
  const render::PuddleLevels levels = terraced_slope(40, 0.12), even = terraced_slope(40, 0);
  const auto shifts = render::level_shifts(levels, 12);
  for (int x = 6; x < 34; ++x) {
    const auto i = static_cast<std::size_t>(20 * 40 + x);
    EXPECT_NEAR(levels.level[i] + shifts[i], even.level[i], rule::kOne / 100.0) << x;
  }
}

// From volume to picture, a terraced puddle is drawn as the slope that it stands for.
TEST(Smooth, TerracesOfAPuddleDoNotShow) {
  const state::Grid grid{48, 24, 24};
  state::Volume volume = test::floor_volume(grid);
  const render::PuddleLevels levels = terraced_slope(48, 0.12, 8);
  for (int z = 0; z < grid.z; ++z)
    for (int x = 0; x < grid.x; ++x)
      test::pour(volume, x, z, static_cast<double>(levels.depth[static_cast<std::size_t>(x)]) / rule::kOne);
  const auto worst = [&](int passes) {
    const DensityField field = field_of(volume, passes, 1);
    const Sight sight(field);
    double most = 0;
    for (double x = 8; x < 40; x += 0.23)
      most = std::max(most, std::abs(sight.height(x, 12.1) - (test::kFloor + 6 + 0.125 * (x - 0.5))));
    return most;
  };
  EXPECT_GT(worst(0), 0.08);
  EXPECT_LT(worst(3), 0.03);
}

// A dome keeps its height and its rim, however much it is smoothed.
TEST(Smooth, PuddlesKeepRimAndHeight) {
  const state::Grid grid{64, 24, 64};
  state::Volume volume = test::floor_volume(grid);
  for (int z = 0; z < grid.z; ++z)
    for (int x = 0; x < grid.x; ++x) {
      const double r = std::hypot(x + 0.5 - 32, z + 0.5 - 32);
      if (r < 24) test::pour(volume, x, z, 6 * (1 - r / 24 * r / 24));
    }
  for (const int passes : {1, 3, 6}) {
    const DensityField field = field_of(volume, passes, 1);
    const Sight sight(field);
    EXPECT_NEAR(sight.height(32, 32), test::kFloor + 6, 0.2) << passes;
    for (const double turn : {0.0, 0.4, 0.785}) {
      const auto height_at = [&](double r) {
        return sight.height(32 + r * std::cos(turn), 32 + r * std::sin(turn));
      };
      double rim = 16;
      while (height_at(rim) > test::kFloor) rim += 0.1;
      EXPECT_NEAR(rim, 24, 0.9) << passes << " passes, direction " << turn;
    }
  }
}

}  // namespace
}  // namespace voxmelt
