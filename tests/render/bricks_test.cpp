// The bricks of every instruction set, told and untold, agree with the plain levels and the plain matter of
// cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "kernel/engine/cpu/instruction_set.h"
#include "kernel/engine/cpu/workers.h"
#include "render/packet/block_distances.h"
#include "render/packet/field_bricks.h"
#include "render/reference/levels.h"
#include "render/reference/matter_cells.h"
#include "tests/kernel/worlds.h"
#include "tests/render/of_materials.h"

namespace voxmelt {
namespace {

using render::FieldBricks;
using render::kBrickPlaces;
using state::Grid;
using worlds::Random;

std::vector<std::pair<std::string, render::BrickLoops>> all_loops() {
  using enum cpu::InstructionSet;
  std::vector<std::pair<std::string, render::BrickLoops>> all;
#if defined(__aarch64__)
  all.emplace_back("neon", render::brick_loops_for<cpu::ArchOf<neon>>());
#else
  if (cpu::supported(sse42)) all.emplace_back("sse4.2", render::brick_loops_for<cpu::ArchOf<sse42>>());
  if (cpu::supported(avx2)) all.emplace_back("avx2", render::brick_loops_for<cpu::ArchOf<avx2>>());
#endif
  return all;
}

template <class Visit>
void for_all(const Grid& grid, const Visit& visit) {
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x) visit(Grid{x, y, z});
}

// Tells whether the places of a brick depend on any intensity.
bool anything(const render::DensityField& field, const Grid& brick) {
  bool any = false;
  for_all({13, 13, 13}, [&](const Grid& i) {
    const Grid c{8 * brick.x - 4 + i.x, 8 * brick.y - 4 + i.y, 8 * brick.z - 4 + i.z};
    if (field.grid().contains(c.x, c.y, c.z) && field.intensity()[field.grid().index(c.x, c.y, c.z)] != 0)
      any = true;
  });
  return any;
}

void expect_plain(const FieldBricks& bricks, const render::DensityField& field, const picture::Look& look) {
  const render::Levels levels(field);
  const render::MatterCells matter(field, levels, look);
  const auto level = [&](const Grid& place) { return levels(place.x - 2, place.y - 2, place.z - 2); };
  for_all(bricks.bricks(), [&](const Grid& brick) {
    if (testing::Test::HasFailure()) return;
    const std::int32_t slot = bricks.slots()[bricks.bricks().index(brick.x, brick.y, brick.z)];
    EXPECT_EQ(slot != 0, anything(field, brick));
    for_all({kBrickPlaces, kBrickPlaces, kBrickPlaces}, [&](const Grid& i) {
      const Grid place{8 * brick.x - 1 + i.x, 8 * brick.y - 1 + i.y, 8 * brick.z - 1 + i.z};
      const std::size_t at = static_cast<std::size_t>(slot) * render::kBrickVolume +
                             static_cast<std::size_t>((i.z * kBrickPlaces + i.y) * kBrickPlaces + i.x);
      ASSERT_EQ(bricks.levels()[at], level(place))
          << "place " << place.x << ", " << place.y << ", " << place.z;
      const picture::Matter the_matter = matter(place.x - 2, place.y - 2, place.z - 2);
      ASSERT_EQ(bricks.matter()[at], static_cast<std::uint32_t>(the_matter.liquid | the_matter.heat << 8 |
                                                                the_matter.obstacle << 16))
          << "place " << place.x << ", " << place.y << ", " << place.z;
    });
  });

  // The blocks must have the right occupancy and slopes.
  std::vector<Grid> occupied;
  Grid low = bricks.blocks(), high{0, 0, 0};
  for_all(bricks.blocks(), [&](const Grid& block) {
    int most = picture::kAir, slopes[3] = {0, 0, 0};
    for_all({5, 5, 5}, [&](const Grid& i) {
      const Grid at{4 * block.x + i.x, 4 * block.y + i.y, 4 * block.z + i.z};
      most = std::max<int>(most, level(at));
      const auto steep = [&](int axis, const Grid& next) {
        slopes[axis] = std::max<int>(slopes[axis], std::abs(level(next) - level(at)));
      };
      if (i.x < 4) steep(0, {at.x + 1, at.y, at.z});
      if (i.y < 4) steep(1, {at.x, at.y + 1, at.z});
      if (i.z < 4) steep(2, {at.x, at.y, at.z + 1});
    });
    const std::int32_t record = bricks.records()[bricks.blocks().index(block.x, block.y, block.z)];
    ASSERT_EQ(record < 0, most < 0) << "block " << block.x << ", " << block.y << ", " << block.z;
    if (most < 0) return;
    constexpr int kUnit = render::kSlopeUnit;
    ASSERT_EQ(record & 255, (slopes[0] + slopes[1] + slopes[2] + kUnit - 1) / kUnit)
        << "block " << block.x << ", " << block.y << ", " << block.z;
    ASSERT_EQ(record >> 8, bricks.slots()[bricks.bricks().index(block.x / 2, block.y / 2, block.z / 2)]);
    occupied.push_back(block);
    low = {std::min(low.x, block.x), std::min(low.y, block.y), std::min(low.z, block.z)};
    high = {std::max(high.x, block.x + 1), std::max(high.y, block.y + 1), std::max(high.z, block.z + 1)};
  });
  for_all(bricks.blocks(), [&](const Grid& block) {
    int distance = FieldBricks::kFarthest;
    for (const Grid& grid : occupied)
      distance = std::min(distance, std::max({std::abs(grid.x - block.x), std::abs(grid.y - block.y),
                                              std::abs(grid.z - block.z)}));
    const std::int32_t record = bricks.records()[bricks.blocks().index(block.x, block.y, block.z)];
    ASSERT_EQ(record < 0 ? record & 255 : 0, distance);
  });
  const auto corner = [](int block) {
    return (std::int64_t{4 * block} - 2) * (1 << 20) + (1 << 19) - (1 << 11);
  };
  // It goes no further than the samples' box: half a cell around the grid, less the rounding of weights.
  const std::int64_t least = -(1 << 19) - (1 << 11);
  const std::int64_t most = bricks.cells().y * (1 << 20) + (1 << 19) - (1 << 11);
  EXPECT_EQ(bricks.occupied().low.x, std::max(corner(low.x), least));
  EXPECT_EQ(bricks.occupied().low.z, std::max(corner(low.z), least));
  EXPECT_EQ(bricks.occupied().high.y, std::min(corner(high.y), most));
}

void edit(state::Volume& volume, const Grid& at, int kind, Random& random) {
  const state::Slot i = volume.at(at.x, at.y, at.z);
  volume.solid.set(at.x, at.y, at.z, kind == 1);
  volume.liquid.set(at.x, at.y, at.z, kind == 2);
  volume.inert.set(at.x, at.y, at.z, kind == 3);
  volume.amount[i] = static_cast<std::uint16_t>(kind == 0          ? 0
                                                : random.one_in(2) ? 4096
                                                                   : 1 + random.below(6000));
  volume.heat[i] = static_cast<std::uint16_t>(kind == 1 || kind == 2 ? random.below(65536) : 0);
  if (!volume.material.empty() && random.one_in(2))
    volume.material[i] = static_cast<std::uint8_t>(random.below(2));
  volume.changed.mark(state::ChangedBricks::kMatter, std::uint64_t{1} << at.x / 64, at.y / 8, at.z / 8);
}

TEST(Bricks, ToldAndUntold) {
  for (const auto& [name, loops] : all_loops())
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
      Random random(seed * 19 + 3);
      const auto side = [&] {
        return random.one_in(4) ? random.any({1, 5, 6, 8, 13, 14, 16}) : random.between(1, 40);
      };
      const Grid grid{side(), side(), side()};
      state::Volume volume(grid);
      volume.changed.follow(grid);
      scene::Look field_look;
      field_look.glow = random.one_in(2);
      field_look.smooth = random.any({0, 1, 3});
      field_look.smooth_solid = random.any({0, 1});
      picture::Look look;
      look.glow = field_look.glow;
      look.glow_cold = random.below(30000);
      look.glow_hot = random.between(20000, 65536);
      test::any_materials(field_look, random);
      for (const render::Tint& tint : render::tints_of(field_look))
        look.tints[static_cast<std::size_t>(look.tint_count++)] = tint;
      test::of_any_materials(volume, field_look, random);
      render::DensityField field;
      FieldBricks bricks;
      cpu::Workers workers(static_cast<int>(1 + seed % 3));
      for (int round = 0; round < 8; ++round) {
        field.update(volume, field_look);
        bricks.update(field, look, round == 0 ? nullptr : &field.refreshed(), workers, loops);
        expect_plain(bricks, field, look);
        if (testing::Test::HasFailure()) FAIL() << name << ", seed " << seed << ", round " << round;
        volume.changed.new_version();
        const Grid first{random.below(grid.x), random.below(grid.y), random.below(grid.z)};
        if (random.one_in(3)) {  // a lump, or a hole
          const int kind = random.below(4), size = random.between(1, 12);
          for_all(grid, [&](const Grid& at) {
            if (at.x >= first.x && at.x < first.x + size && at.y >= first.y && at.y < first.y + size &&
                at.z >= first.z && at.z < first.z + size)
              edit(volume, at, kind, random);
          });
        } else {
          edit(volume, first, random.below(4), random);
        }
      }
    }
}

// Rows are longer than a word of 64 blocks.
TEST(Bricks, DistancesOfLongRows) {
  Random random(5);
  for (const Grid& blocks : {Grid{1, 1, 1}, {64, 2, 3}, {65, 1, 2}, {130, 3, 1}, {8, 40, 8}}) {
    std::vector<std::uint8_t> occupied(blocks.cells());
    for (int i = 0; i < 4; ++i) {
      const std::vector<std::uint8_t> found = render::block_distances(occupied, blocks, 16);
      for_all(blocks, [&](const Grid& a) {
        int distance = 16;
        for_all(blocks, [&](const Grid& b) {
          if (occupied[blocks.index(b.x, b.y, b.z)] != 0)
            distance =
                std::min(distance, std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)}));
        });
        ASSERT_EQ(found[blocks.index(a.x, a.y, a.z)], distance) << a.x << ", " << a.y << ", " << a.z;
      });
      occupied[static_cast<std::size_t>(random.below(static_cast<int>(occupied.size())))] = 1;
    }
  }
}

}  // namespace
}  // namespace voxmelt
