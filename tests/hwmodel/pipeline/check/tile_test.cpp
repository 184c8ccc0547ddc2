// Grids that are cut into tiles give the software's bits in the cycles of the closed form. Every cell is
// owned by one tile and counted once, and faults of tiles are found where they were planted.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/pipeline/time/prediction.h"
#include "tests/hwmodel/pipeline/check/lockstep_world.h"
#include "tests/rounds.h"

namespace voxmelt::hwmodel {
namespace {

std::string where(const Start& start, const Configuration& c) {
  const state::Grid& g = start.volume.grid;
  return start.name + ", " + std::to_string(g.x) + " x " + std::to_string(g.y) + " x " + std::to_string(g.z) +
         ", " + name_of(c) + ", tile " + std::to_string(c.tile);
}

int tiles_of(const Start& start, const Configuration& c) {
  return design_of(start.parameters, start.volume.grid, c).shape.tiles();
}

// Every block has one owner, whose window holds the halo on both sides or ends with the grid.
TEST(Tiles, EveryBlockHasOneOwner) {
  int cut = 0;
  for (int blocks = 1; blocks < 40; ++blocks)
    for (int halo = 0; halo < 5; ++halo)
      for (int tile = 2 * halo + 1; tile < 14; ++tile) {
        const Shape shape{{blocks * 4 - 1, 3, 2}, 4, std::min(tile, blocks), halo};
        ASSERT_EQ(shape.tiled(), tile < blocks);
        std::vector<int> owners(static_cast<std::size_t>(blocks));
        for (int k = 0; k < shape.tiles(); ++k) {
          const int first = shape.first_block(k), end = first + shape.blocks();
          ASSERT_TRUE(first >= 0 && end <= blocks);
          ASSERT_LT(shape.owned_begin(k), shape.owned_end(k)) << blocks << ", " << halo << ", " << tile;
          ASSERT_TRUE(first == 0 || shape.owned_begin(k) - first >= halo);
          ASSERT_TRUE(end == blocks || end - shape.owned_end(k) >= halo);
          for (int block = shape.owned_begin(k); block < shape.owned_end(k); ++block) {
            ++owners[static_cast<std::size_t>(block)];
            ASSERT_EQ(shape.owner(block), k);
          }
        }
        ASSERT_EQ(std::count(owners.begin(), owners.end(), 1), blocks);
        cut += shape.tiles() > 1;
      }
  EXPECT_GT(cut, 900);
}

// A pass ends when the tokens of all tiles have been written: each token has an ordinal of its own.
TEST(Tiles, AnOrdinalForEveryToken) {
  const Shape shape{{22, 3, 2}, 2, 5, 1};
  ASSERT_EQ(shape.tiles(), 3);
  std::set<std::int64_t> ordinals;
  for (int z = 0; z < 2; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 22; ++x) {
        const std::int64_t ordinal = owned_ordinal(shape, x, y, z);
        ordinals.insert(ordinal);
        const int tile = static_cast<int>(ordinal / shape.tokens());
        const Place place = place_of(shape, ordinal % shape.tokens(), tile);
        ASSERT_TRUE(place.x == x - x % 2 && place.y == y && place.z == z && shape.owns(tile, x));
        Place walked = begin_of(shape, tile);
        for (std::int64_t i = 0; i < ordinal % shape.tokens(); ++i) walked.next(shape);
        ASSERT_TRUE(walked.x == place.x && walked.y == y && walked.z == z && walked.left == place.left);
      }
  EXPECT_EQ(ordinals.size(), 11u * 3 * 2);
}

// By hand, conduction with all neighbours reaches 1 + 1 + 1 cells, and pattern and apply 1 + 1.
TEST(Tiles, TheHaloIsWhatTheStagesReach) {
  Start start = hostile_start(0, rule::Law::paper, {40, 4, 4});
  for (std::uint64_t seed = 1; !start.parameters.heat.enabled || start.parameters.heat.neighbours != 26;
       ++seed)
    start = hostile_start(seed, rule::Law::paper, {40, 4, 4});
  Configuration c{2, 2, 2, 0};
  EXPECT_EQ(reach_of_step({start.parameters, {start.volume.grid, 2}}), 5);
  c.tile = 22;
  const Shape shape = design_of(start.parameters, start.volume.grid, c).shape;
  EXPECT_EQ(shape.halo, 5) << "2 steps of 5 cells, in blocks of 2";
  EXPECT_EQ(shape.tiles(), 10) << "one block each between two cuts, six at the ends: 6 + 8 x 1 + 6";
  EXPECT_EQ(recomputed_cells(shape), (10 * 22 - 40) * 4 * 4);
  c.tile = 24;  // 7 + 3 x 2 + 7 blocks: five tiles
  EXPECT_EQ(design_of(start.parameters, start.volume.grid, c).shape.tiles(), 5);
  c.tile = 20;
  EXPECT_NE(tile_problem(start.parameters, start.volume.grid, c), "");
  EXPECT_THROW(design_of(start.parameters, start.volume.grid, c), std::invalid_argument);
}

// Runs a part of 200 hostile worlds. The quick test takes 40, and the slow one the others.
void hostile_worlds(std::uint64_t begin, std::uint64_t end) {
  int cut = 0, most = 0;
  for (std::uint64_t seed = begin; seed < end; ++seed) {
    worlds::Random random(seed + 31);
    const state::Grid grid{random.between(1, 60), random.between(1, 8), random.between(1, 12)};
    Start start = hostile_start(seed + 2000, seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous, grid);
    Configuration c{random.any({1, 2, 3, 4, 5, 6, 8}), random.between(1, 3), random.any({1, 2, 3, 8}),
                    random.one_in(2) ? 0 : seed + 1};
    c.overlap = !random.one_in(3);
    if (random.one_in(3)) c.substeps = 2;
    c.tile = narrow(start, c, random.between(0, 5));
    ASSERT_TRUE(agrees(start, c, 6)) << where(start, c);
    const int tiles = tiles_of(start, c);
    cut += tiles > 1;
    most = std::max(most, tiles);
  }
  std::printf("             %d of %d worlds were cut, into %d tiles at most\n", cut,
              static_cast<int>(end - begin), most);
  EXPECT_GT(cut, static_cast<int>(end - begin) / 3);
}
TEST(Tiles, HostileWorlds) { hostile_worlds(0, 40); }
TEST(TilesLong, HostileWorlds) { hostile_worlds(40, 200); }

// The cycles are exactly the predicted ones, with and without overlap. This includes shallow grids, whose
// tiles do not overlap.
TEST(Tiles, ClosedFormIsExact) {
  int configurations = 0, cut = 0;
  for (const int lanes : {1, 2, 4})
    for (const int cascade : {1, 2, 3})
      for (const int depth : {1, 2, 16})
        for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
          for (const bool overlap : {false, true})
            for (const int planes : {1, 9, 31}) {
              worlds::Random random(static_cast<std::uint64_t>(++configurations));
              if (!all_rounds() && (configurations - 1) / 12 % 2 == 1) continue;  // every second depth
              Start start = hostile_start(static_cast<std::uint64_t>(configurations), law,
                                          {random.between(12, 40), random.between(1, 4), planes});
              if (law == rule::Law::viscous) start.parameters.flow.viscous.substeps = 1;
              Configuration c{lanes, cascade, depth, 0, 1, overlap};
              c.tile = narrow(start, c, random.between(0, 3));
              ASSERT_TRUE(agrees(start, c, static_cast<std::uint32_t>(2 * cascade + 1))) << where(start, c);
              cut += tiles_of(start, c) > 1;
            }
  EXPECT_EQ(configurations, 324);
  EXPECT_GT(cut, all_rounds() ? 200 : 100);
  std::printf("             %d of %d grids were cut\n", cut, configurations);
}

// The closed form of equal passes is worked by hand. It has one fill and drain for a train of all tiles of
// all passes, one for each pass, or one for each tile.
TEST(Tiles, CyclesOfEqualPasses) {
  Start start = hostile_start(3, rule::Law::paper, {40, 3, 60});
  start.parameters.heat.radiation = false;
  for (const bool overlap : {true, false}) {
    Configuration c{2, 2, 2, 0, 1, overlap};
    c.tile = narrow(start, c, 3);
    const VerifyReport report = lockstep(start, c, 8);
    ASSERT_EQ(report.mismatch, nullptr) << text_of(*report.mismatch);
    EXPECT_EQ(report.passes, 4);
    const Design design = design_of(start.parameters, start.volume.grid, c);
    ASSERT_GT(design.shape.tiles(), 2);
    const Pass pass{.steps = 2};
    EXPECT_EQ(report.cycles, predicted_passes(design, c, pass, 4));
    const std::int64_t one = predicted_cycles(design, c, pass), streams = 4 * design.shape.tiles();
    EXPECT_EQ(report.cycles, overlap ? one + (streams - 1) * design.shape.tokens() : streams * one);
    for (const StageReport& stage : report.stages)
      if (stage.kind != StageKind::feed) {
        EXPECT_EQ(stage.cycles.busy, streams * design.shape.tokens()) << name_of(stage.kind);
      }
  }
}

// The machine holds a few tokens more than a tile has. But the tile that writes the cells which the next pass
// reads first begins 14 blocks behind them. So no pass waits, and each costs its tokens alone.
TEST(Tiles, APassWaitsOnlyUntilTheOwnerHasWritten) {
  Start start = hostile_start(0, rule::Law::paper, {40, 6, 6});
  start.parameters.heat = {};
  start.parameters.heat.enabled = true;
  start.parameters.flow.fall.hang = 2000;
  Configuration c;
  c.lanes = 1;
  c.cascade = 2;
  c.tile = 26;
  const Shape shape = design_of(start.parameters, start.volume.grid, c).shape;
  ASSERT_EQ(shape.tiles(), 2);
  ASSERT_EQ(shape.blocks(), 26);
  std::int64_t two = 0, four = 0;
  ASSERT_TRUE(agrees(start, c, 2, &two) && agrees(start, c, 4, &four));
  EXPECT_GT(two - 2 * 936, 936) << "tokens on their way";
  EXPECT_EQ(four - two, 2 * 936) << "26 x 6 x 6 tokens of each tile";
}

// The memories of a tile's few columns are the same, whatever the width of the grid.
TEST(Tiles, BuffersAreThoseOfATile) {
  const auto bits_of = [](int width) {
    const Start start = hostile_start(8, rule::Law::paper, {width, 4, 4});
    Configuration c{4, 1, 2, 0};
    c.tile = 32;
    const Design design = design_of(start.parameters, start.volume.grid, c);
    std::int64_t bits = 0;
    for (const auto& stage : make_step(design))
      for (const BufferCost& buffer : stage->buffers()) bits += buffer.total();
    return bits;
  };
  EXPECT_EQ(bits_of(32), bits_of(32 + 5 * (32 - 16)));  // both have full tiles
  EXPECT_LE(bits_of(1000), bits_of(32));
}

class TileFaults : public testing::TestWithParam<FaultInfo> {};

// A fault in a grid that is cut is found where it was planted. This holds for those of tiles, and for all
// others.
TEST_P(TileFaults, IsFoundWhereItWasPlanted) {
  const FaultInfo& fault = GetParam();
  const bool of_tiles = is_of_tiles(fault.fault);
  int struck = 0;
  for (std::uint64_t seed = 0; seed < 200 && struck < (of_tiles ? 6 : 2); ++seed) {
    worlds::Random random(seed + 777);
    const state::Grid grid{random.between(20, 40), random.between(3, 6), random.between(3, 24)};
    const rule::Law law = seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous;
    const Start start = start_for(fault.fault, seed + 40, law, grid);
    Configuration c{random.any({1, 2, 3, 4}), random.between(1, 2), random.any({1, 2, 4}),
                    random.one_in(2) ? 0 : seed};
    c.tile = narrow(start, c, random.between(2, 6));
    c.coded = is_of_the_code(fault.fault) || seed % 4 == 1;
    const VerifyReport report = lockstep(start, c, 6, fault.fault, 2);
    if (!report.strike) {
      ASSERT_EQ(report.mismatch, nullptr) << where(start, c) << ": " << text_of(*report.mismatch);
      continue;
    }
    ++struck;
    ASSERT_NE(report.mismatch, nullptr) << where(start, c) << ": struck and not found";
    const auto& at = *report.strike;
    ASSERT_TRUE(report.found_where_planted())
        << where(start, c) << ": planted in " << at.where << ", step " << at.step << ", cell " << at.x << ", "
        << at.y << ", " << at.z << "; found " << text_of(*report.mismatch);
  }
  if (of_tiles) {
    EXPECT_GE(struck, 3);
  }
}

INSTANTIATE_TEST_SUITE_P(Some, TileFaults, testing::ValuesIn(some_of(all_faults())), [](const auto& chosen) {
  std::string name;
  for (const char c : chosen.param.name) name += c == '-' ? '_' : c;
  return name;
});

}  // namespace
}  // namespace voxmelt::hwmodel
