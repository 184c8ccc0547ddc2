// The field that is drawn has a filter, column heights and ground below films, and is updated brick by brick.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "render/density/density_field.h"
#include "render/density/low_pass.h"
#include "tests/render/shapes.h"
#include "tests/render/sight.h"

namespace voxmelt {
namespace {

using render::DensityField;

scene::Look look_with_passes(int liquid, int solid = 1) {
  scene::Look look;
  look.smooth = liquid;
  look.smooth_solid = solid;
  return look;
}

void expect_same_field(const DensityField& a, const DensityField& b) {
  EXPECT_TRUE(a.intensity() == b.intensity());
  EXPECT_TRUE(a.solid() == b.solid());
  EXPECT_TRUE(a.liquid() == b.liquid());
  EXPECT_TRUE(a.heat() == b.heat());
  EXPECT_EQ(a.wetness(), b.wetness());
}

TEST(LowPass, KeepsConstants) {
  const state::Grid grid{19, 8, 11};
  for (const int value : {0, 1, 777, render::kFull})
    for (int passes = 0; passes <= render::kMaxPasses; ++passes) {
      render::Values<std::uint16_t> constant(grid.cells());
      std::fill_n(constant.data(), constant.size(), static_cast<std::uint16_t>(value));
      EXPECT_TRUE(render::low_pass(grid, passes, constant) == constant) << value << " after " << passes;
    }
}

TEST(LowPass, KeepsSumsAwayFromTheBorder) {
  const state::Grid grid{21, 20, 22};
  std::mt19937 random(7);
  render::Values<std::uint16_t> cells(grid.cells());
  for (int z = 6; z < 16; ++z)
    for (int y = 6; y < 14; ++y)
      for (int x = 6; x < 15; ++x)
        cells[grid.index(x, y, z)] = static_cast<std::uint16_t>(random() % (render::kFull + 1));
  const auto sum = [](const render::Values<std::uint16_t>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
  };
  // Every axis of a pass rounds quarters to nearest and halves upwards, which is an eighth upwards in the
  // mean. Beyond that the errors add up like a random walk.
  double roundings = 0;
  for (int passes = 1; passes <= render::kMaxPasses; ++passes) {
    roundings += 3.0 * (10 + 2 * passes) * (8 + 2 * passes) * (9 + 2 * passes);
    const double gained = sum(render::low_pass(grid, passes, cells)) - sum(cells);
    EXPECT_LT(gained, roundings / 8 + 2 * std::sqrt(roundings)) << passes;
    EXPECT_GT(gained, roundings / 16) << passes;
  }
}

TEST(LowPass, HasTheBinomialResponse) {
  const state::Grid grid{9, 9, 9};
  render::Values<std::uint16_t> cells(grid.cells());
  cells[grid.index(4, 4, 4)] = 64 * 100;
  const auto filtered = render::low_pass(grid, 1, cells);
  EXPECT_EQ(filtered[grid.index(4, 4, 4)], 800);
  EXPECT_EQ(filtered[grid.index(5, 4, 4)], 400);
  EXPECT_EQ(filtered[grid.index(5, 3, 4)], 200);
  EXPECT_EQ(filtered[grid.index(5, 3, 5)], 100);
  EXPECT_EQ(filtered[grid.index(6, 4, 4)], 0);
}

TEST(CellFields, AmountsAreLinearAndCapped) {
  state::Volume volume(state::Grid{8, 8, 8});
  const auto set = [&](int x, int amount) {
    volume.liquid.set(x, 4, 4, true);
    volume.amount[volume.at(x, 4, 4)] = static_cast<std::uint16_t>(amount);
  };
  set(1, 2048);
  set(3, 4096);
  set(5, 9000);
  const auto fields = render::cell_fields(volume);
  EXPECT_EQ(fields.intensity[volume.grid.index(1, 4, 4)], render::kFull / 2);
  EXPECT_EQ(fields.intensity[volume.grid.index(3, 4, 4)], render::kFull);
  EXPECT_EQ(fields.intensity[volume.grid.index(5, 4, 4)], render::kFull);
}

TEST(CellFields, GroundIsFilledOnlyNearMatter) {
  state::Volume volume = test::floor_volume({24, 12, 24});
  test::pour(volume, 4, 4, 0.5);
  const auto fields = render::cell_fields(volume);
  EXPECT_EQ(fields.intensity[volume.grid.index(4, 1, 4)], render::kFull);
  EXPECT_GT(fields.intensity[volume.grid.index(5, 1, 4)], render::kFull / 2);
  EXPECT_EQ(fields.intensity[volume.grid.index(12, 1, 4)], 0);
  EXPECT_EQ(fields.liquid[volume.grid.index(4, 1, 4)], 0);
}

// The numbers are all those of the worked column of docs/picture/field.md, section 10.
TEST(DensityField, WorkedColumn) {
  const state::Grid grid{20, 12, 20};
  state::Volume volume = test::floor_volume(grid);
  for (int z = 0; z < grid.z; ++z)
    for (int x = 0; x < grid.x; ++x) test::pour(volume, x, z, 1.5);
  DensityField field;
  field.update(volume, look_with_passes(3, 1));
  const std::size_t column = 10 * 20 + 9;
  const auto& columns = field.cells().columns();
  EXPECT_EQ(columns.stand(column), (render::Stand{2, 2, 2, 4, 0, 4096, false}));
  EXPECT_EQ(columns.plan(column), (render::Plan{2, 0, 2, 4, 0}));
  EXPECT_EQ(field.ground()[column], 8192);
  EXPECT_EQ(field.wetness()[column], 4096);
  const auto up = [&](const render::Values<std::uint16_t>& the_values) {
    std::vector<int> values;
    values.reserve(7);
    for (int y = 0; y < 7; ++y) values.push_back(the_values[grid.index(9, y, 10)]);
    return values;
  };
  using Up = std::vector<int>;
  EXPECT_EQ(up(field.cells().intensity), (Up{65280, 65280, 65280, 32640, 0, 0, 0}));
  EXPECT_EQ(up(render::low_pass(grid, 1, field.cells().intensity)),
            (Up{65280, 65280, 57120, 32640, 8160, 0, 0}));
  EXPECT_EQ(up(render::low_pass(grid, 2, field.cells().intensity)),
            (Up{65280, 63240, 53040, 32640, 12240, 2040, 0}));
  EXPECT_EQ(up(field.liquid()), (Up{6630, 18360, 28050, 25500, 13770, 4080, 510}));
  EXPECT_EQ(up(field.intensity()), (Up{64770, 61200, 50490, 32640, 14790, 4080, 510}));
}

// The surface above a wide flat column lies at the liquid's height, whatever the last cell holds.
TEST(DensityField, ReconstructsColumnHeights) {
  const state::Grid grid{24, 24, 24};
  for (int passes = 0; passes <= render::kMaxPasses; ++passes)
    for (double height = 0.1; height < 5; height += 0.13) {
      state::Volume volume = test::floor_volume(grid);
      for (int z = 0; z < grid.z; ++z)
        for (int x = 0; x < grid.x; ++x) test::pour(volume, x, z, height);
      DensityField field;
      field.update(volume, look_with_passes(passes));
      const auto hit = test::Sight(field).find({12.3, 40, 11.7}, {0, -1, 0});
      ASSERT_TRUE(hit.has_value());
      EXPECT_NEAR(hit->point.y, test::kFloor + height, 0.2) << height << " with " << passes << " passes";
      EXPECT_GT(hit->normal.y, 0.999);
    }
}

// The voxelised bed has terraces. Its stored offset takes them out of the surface of the liquid on it.
TEST(DensityField, FollowsASlopingBed) {
  const state::Grid grid{48, 32, 24};
  state::Volume volume(grid);
  const auto bed_height = [](double x) { return 6 + 0.22 * x; };
  for (int z = 0; z < grid.z; ++z)
    for (int x = 0; x < grid.x; ++x) {
      const double height = bed_height(x + 0.5);
      const int bed = static_cast<int>(std::lround(height));
      for (int y = 0; y < bed; ++y) {
        volume.inert.set(x, y, z, true);
        volume.amount[volume.at(x, y, z)] = rule::kBedHalf;
      }
      volume.amount[volume.at(x, bed - 1, z)] =
          static_cast<std::uint16_t>(std::lround(rule::kBedHalf + (height - bed) * rule::kOne));
      for (int k = 0; k < 2; ++k) {
        volume.liquid.set(x, bed + k, z, true);
        volume.amount[volume.at(x, bed + k, z)] = rule::kOne;
      }
    }
  DensityField field;
  field.update(volume, look_with_passes(2));
  const test::Sight sight(field);
  for (double x = 8; x < 40; x += 0.37) EXPECT_NEAR(sight.height(x, 12.2), bed_height(x) + 2, 0.2) << x;
}

TEST(DensityField, UpdatesLikeAFreshField) {
  const state::Grid grid{53, 50, 57};
  for (const scene::Look& look : {look_with_passes(2), look_with_passes(render::kMaxPasses, 3)}) {
    state::Volume volume = test::ball_and_puddle(grid);
    DensityField kept;
    kept.update(volume, look);

    std::mt19937 random(11);
    for (int round = 0; round < 12; ++round) {
      for (int change = 0; change < 3; ++change) {
        const int x = static_cast<int>(random() % 53), y = 2 + static_cast<int>(random() % 48),
                  z = static_cast<int>(random() % 57);
        if (volume.solid.test(x, y, z)) continue;
        const state::Slot i = volume.at(x, y, z);
        volume.amount[i] = static_cast<std::uint16_t>(random() % 5000);
        volume.heat[i] = static_cast<std::uint16_t>(random());
        volume.liquid.set(x, y, z, volume.amount[i] > 0);
      }
      const int filtered = kept.update(volume, look);
      EXPECT_LT(filtered, static_cast<int>(kept.bricks().cells()));
      DensityField fresh;
      fresh.update(volume, look);
      expect_same_field(kept, fresh);
    }
    EXPECT_EQ(kept.update(volume, look), 0) << "nothing changed";
  }
}

}  // namespace
}  // namespace voxmelt
