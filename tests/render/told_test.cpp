// A field that is told of changed bricks equals a plain field of the whole volume. This holds after steps of
// any implementation, after edits that are told, and however the field is used.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/kernel/engine/parallel/equal.h"
#include "tests/render/of_materials.h"
#include "tests/render/plain_field.h"
#include "tests/render/shapes.h"

namespace voxmelt {
namespace {

using render::DensityField;
using state::ChangedBricks;
using worlds::Random;

scene::Look any_look(Random& random) {
  scene::Look look;
  look.smooth = random.any({0, 1, 3, 3, 6});
  look.smooth_solid = random.any({0, 1, 1, 4});
  look.glow = random.one_in(3);
  test::any_materials(look, random);
  return look;
}

scene::Terrain any_terrain(Random& random, const state::Grid& grid) {
  scene::Terrain terrain;
  if (random.one_in(2)) return terrain;
  terrain.x = grid.x;
  terrain.z = grid.z;
  for (int i = 0; i < grid.x * grid.z; ++i)
    terrain.height.push_back(static_cast<float>(random.below(60) - 10) * 0.1f);
  return terrain;
}

// Holds everything that may be drawn, to be compared brick by brick.
struct Shown {
  explicit Shown(const DensityField& field)
      : intensity(field.intensity()),
        solid(field.solid()),
        liquid(field.liquid()),
        heat(field.heat()),
        obstacle(field.obstacle()) {}
  render::Values<std::uint16_t> intensity, solid, liquid, heat, obstacle;
};

// Expects that every brick with a visible change is among those that were told.
void expect_refreshed(const Shown& before, const DensityField& field) {
  const Shown after(field);
  const auto& told = field.refreshed();
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  for (int i = 0; i < static_cast<int>(field.bricks().cells()); ++i) {
    if (std::binary_search(told.begin(), told.end(), static_cast<std::uint32_t>(i))) continue;
    const state::Grid& bricks = field.bricks();
    const state::Grid brick{i % bricks.x, i / bricks.x % bricks.y, i / bricks.x / bricks.y};
    const auto box = render::cells_of(field.grid(), brick);
    render::for_rows(field.grid(), box, [&](std::size_t at, const state::Grid&, int cells) {
      for (std::size_t c = at; c < at + static_cast<std::size_t>(cells); ++c) {
        ASSERT_EQ(before.intensity[c], after.intensity[c]) << "brick " << i;
        ASSERT_EQ(before.solid[c], after.solid[c]) << "brick " << i;
        ASSERT_EQ(before.liquid[c], after.liquid[c]) << "brick " << i;
        ASSERT_EQ(before.heat[c], after.heat[c]) << "brick " << i;
      }
    });
  }
}

TEST(Told, AfterStepsOfEveryImplementation) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
    for (const step::Implementation& implementation : run::implementations().all()) {
      if (!implementation.supported) continue;
      for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Random random(seed * 131 + (law == rule::Law::paper ? 1 : 2));
        const state::Grid grid{random.between(3, 140), random.between(3, 30), random.between(3, 20)};
        const rule::Parameters parameters = worlds::hostile_parameters(random, law, grid);
        state::Volume start = worlds::hostile_volume(random, parameters, grid);
        if (seed % 2 == 1) worlds::thin_out(random, start);
        step::Tuning tuning;
        tuning.tile_shift = random.any({0, 3, 5});
        run::Simulation simulation(parameters, start, implementation, tuning);
        scene::Look look = any_look(random);
        if (!start.material.empty()) test::sixteen_materials(look, random);
        const scene::Terrain terrain = any_terrain(random, grid);
        DensityField field;
        for (int round = 0; round < 4; ++round) {
          const int threads = 1 + round % 2;
          field.update(simulation.volume(), look, terrain, threads);
          test::expect_plain(field, simulation.volume(), look, terrain);
          if (testing::Test::HasFailure())
            FAIL() << implementation.name << ", seed " << seed << ", round " << round;
          EXPECT_EQ(field.update(simulation.volume(), look, terrain, threads), 0) << "nothing changed";
          EXPECT_TRUE(field.refreshed().empty());
          worlds::steps(simulation, random.between(1, 3));
        }
      }
    }
}

void edit(state::Volume& volume, int x, int y, int z, int kind, Random& random) {
  const state::Slot at = volume.at(x, y, z);
  volume.solid.set(x, y, z, kind == 1);
  volume.liquid.set(x, y, z, kind == 2);
  volume.inert.set(x, y, z, kind == 3);
  volume.amount[at] = static_cast<std::uint16_t>(kind == 0 ? 0 : 1 + random.below(6000));
  volume.heat[at] = static_cast<std::uint16_t>(kind == 1 || kind == 2 ? random.below(65536) : 0);
}

// Makes a slope of ground with a puddle, a wall and a lump, as columns tell all of these apart.
state::Volume slope(const state::Grid& grid, Random& random) {
  state::Volume volume(grid);
  worlds::for_each(worlds::whole(grid), [&](int x, int y, int z) {
    const int bed = 1 + (x + z) / 9;
    if (y < bed || (x == grid.x / 2 && y < bed + 9))
      edit(volume, x, y, z, 3, random);
    else if (x * 2 < grid.x && y < bed + 2)
      edit(volume, x, y, z, 2, random);
    else if (x > grid.x - 9 && y > 10)
      edit(volume, x, y, z, 1, random);
  });
  return volume;
}

TEST(Told, AfterEditsThatAreTold) {
  Random random(41);
  for (const state::Grid& grid : {state::Grid{75, 33, 30}, {40, 20, 41}}) {
    state::Volume volume = slope(grid, random);
    volume.changed.follow(grid);
    volume.material = state::Field<std::uint8_t>(grid);
    scene::Look look = any_look(random);
    scene::Terrain terrain = any_terrain(random, grid);
    DensityField field;
    for (int round = 0; round < 60; ++round) {
      if (round % 11 == 10) {
        look = any_look(random);
        volume.material = state::Field<std::uint8_t>(grid);
      }
      if (round % 13 == 12) terrain = any_terrain(random, grid);
      const bool same_use = round > 0 && round % 11 != 10 && round % 13 != 12;
      const Shown before(field);
      const int filtered = field.update(volume, look, terrain);
      test::expect_plain(field, volume, look, terrain);
      if (testing::Test::HasFailure()) FAIL() << "round " << round;
      if (same_use) {
        EXPECT_LT(filtered, static_cast<int>(field.bricks().cells())) << "not everything is refreshed";
        expect_refreshed(before, field);
      }
      volume.changed.new_version();
      for (int change = random.between(1, 4); change > 0; --change) {
        const int x = random.below(grid.x), z = random.below(grid.z);
        int y = random.below(grid.y);
        if (random.one_in(2)) y = std::min(1 + (x + z) / 9 + random.between(-1, 3), grid.y - 1);
        if (random.one_in(4) && volume.inert.test(x, y, z))
          volume.amount[volume.at(x, y, z)] = static_cast<std::uint16_t>(random.between(1, 4000));
        else
          edit(volume, x, y, z, random.below(4), random);
        if (!look.materials.empty())
          volume.material[volume.at(x, y, z)] =
              static_cast<std::uint8_t>(random.below(static_cast<int>(look.materials.size())));
        volume.changed.mark(ChangedBricks::kMatter, std::uint64_t{1} << x / 64, y / 8, z / 8);
      }
    }
  }
}

// A puddle that is moved up or down carries a change into the brick below or above. One that rises into the
// next brick is a deeper one in all of its cells.
TEST(Told, PuddlesCrossBricks) {
  const state::Grid grid{16, 24, 16};
  for (const int smooth : {0, 2})
    for (const int bed : {1000, 2048, 3000})
      for (const auto& [depth, y, amount] : {std::array{12, 8, 100}, {12, 7, 100}, {6, 8, 900}, {6, 7, 0}}) {
        state::Volume volume = test::floor_volume(grid);
        worlds::for_each(worlds::whole(grid), [&](int x, int v, int z) {
          if (v == test::kFloor - 1) volume.amount[volume.at(x, v, z)] = static_cast<std::uint16_t>(bed);
        });
        for (int x = 2; x < 9; ++x) test::pour(volume, x, 7, depth);
        volume.changed.follow(grid);
        scene::Look look;
        look.smooth = smooth;
        DensityField field;
        field.update(volume, look);
        volume.changed.new_version();
        worlds::put(volume, 5, y, 7, amount);
        volume.changed.mark(ChangedBricks::kMatter, 1, y / 8, 0);
        field.update(volume, look);
        test::expect_plain(field, volume, look);
        if (testing::Test::HasFailure()) FAIL() << smooth << " " << bed << " " << depth << " " << y;
      }
}

TEST(Told, WhatIsNotToldIsNotSeen) {
  Random random(43);
  const state::Grid grid{150, 20, 20};
  state::Volume volume = slope(grid, random);
  volume.changed.follow(grid);
  DensityField field;
  field.update(volume, {}, {});
  const auto before = field.intensity();
  for (int y = 0; y < grid.y; ++y) edit(volume, 3, y, 4, 2, random);
  EXPECT_EQ(field.update(volume, {}, {}), 0);
  volume.changed.new_version();
  volume.changed.mark(ChangedBricks::kMatter, 4, 0, 0);  // bricks of another place
  EXPECT_EQ(field.update(volume, {}, {}), 0);
  EXPECT_TRUE(field.intensity() == before);
  for (int y = 0; y < 3; ++y) volume.changed.mark(ChangedBricks::kMatter, 1, y, 0);
  EXPECT_EQ(field.update(volume, {}, {}), 0) << "a version that has been seen";
  volume.changed.forget();
  EXPECT_GT(field.update(volume, {}, {}), 0);
  test::expect_plain(field, volume, {});
}

// Heat alone is told apart, and read only if the look glows.
TEST(Told, HeatIsReadWhereItGlows) {
  Random random(47);
  const state::Grid grid{20, 20, 20};
  state::Volume volume = slope(grid, random);
  volume.changed.follow(grid);
  scene::Look dull, glowing;
  glowing.glow = true;
  DensityField one, other;
  one.update(volume, dull);
  other.update(volume, glowing);
  volume.changed.new_version();
  for (int z = 0; z < 8; ++z) volume.heat[volume.at(2, 2, z)] ^= 0x5555;
  volume.changed.mark(ChangedBricks::kHeat, 1, 0, 0);
  EXPECT_EQ(one.update(volume, dull), 0);
  EXPECT_GT(other.update(volume, glowing), 0);
  test::expect_plain(other, volume, glowing);
}

// One field serves two simulations, their copies, other grids, terrains and looks in turn.
TEST(Told, OtherVolumesAreReadAnew) {
  Random random(53);
  const auto start = [&](const state::Grid& grid) {
    state::Volume volume = test::floor_volume(grid);
    for (int i = 0; i < 40; ++i)
      test::pour(volume, random.below(grid.x), random.below(grid.z), 0.5 + random.below(4));
    return volume;
  };
  const step::Implementation& fastest = run::implementations().widest();
  std::vector<run::Simulation> simulations;
  for (const state::Grid& grid : {state::Grid{40, 20, 24}, {40, 20, 24}, {24, 20, 40}})
    simulations.emplace_back(worlds::paper_showcase(), start(grid), fastest);
  DensityField field;
  for (int round = 0; round < 24; ++round) {
    run::Simulation& simulation = simulations[static_cast<std::size_t>(random.below(3))];
    const state::Grid grid = simulation.volume().grid;
    if (!random.one_in(3)) simulation.step();
    const scene::Terrain terrain = random.one_in(2) ? test::floor_terrain(grid) : scene::Terrain{};
    const scene::Look look = any_look(random);
    if (random.one_in(3)) {
      state::Volume copy = simulation.volume();
      field.update(copy, look, terrain);
      worlds::put(copy, 1, 5, 1, 700);  // a change in a copy is not told
      field.update(copy, look, terrain);
      test::expect_plain(field, copy, look, terrain);
    } else {
      if (random.one_in(4)) worlds::put(simulation.mutable_volume(), 9, 9, 9, 900);
      field.update(simulation.volume(), look, terrain);
      test::expect_plain(field, simulation.volume(), look, terrain);
    }
    if (testing::Test::HasFailure()) FAIL() << "round " << round;
  }
}

}  // namespace
}  // namespace voxmelt
