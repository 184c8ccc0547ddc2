// The stage `fall` alone: columns turned by hand, random columns turned by a loop of the test, what it costs,
// and its faults.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hwmodel/pipeline/faults/planted_stages.h"
#include "hwmodel/pipeline/model/lag.h"
#include "hwmodel/pipeline/model/pipeline.h"
#include "tests/hwmodel/pipeline/model/stage_run.h"

namespace voxmelt::hwmodel {
namespace {

constexpr bool kHot = true;

Design design_of(state::Grid grid, int lanes) {
  Design design{{}, {grid, lanes}};
  design.parameters.heat.enabled = kHot;
  design.parameters.pieces.fall = true;
  return design;
}

state::Volume run_fall(const Design& design, const StageMaker& make, const state::BitPlane& falls,
                       const state::Volume& before, StageRun& run) {
  Stages stages;
  stages.push_back(make(StageKind::fall, design));
  run.falls = &falls;
  return run_stages(design, stages, step::Moment(3), nullptr, before, run);
}

// The amounts of a column, its lowest cell first. Solids have odd ones.
void put_column(state::Volume& volume, int x, const std::vector<int>& amounts) {
  for (std::size_t y = 0; y < amounts.size(); ++y) {
    const int amount = amounts[y], height = static_cast<int>(y);
    if (amount % 2 == 1)
      worlds::put_solid(volume, x, height, 0, amount, 10 * amount);
    else if (amount > 0)
      worlds::put(volume, x, height, 0, amount, 0, 10 * amount);
  }
}

// By hand, from docs/automaton.md: two cells fall through air, three push liquid up, two pieces of a column
// turn apart, and one cell falls from the top of the grid.
TEST(PiecesStage, ColumnsTurnRoundOnceByHand) {
  const std::vector<std::vector<int>> before{
      {0, 0, 11, 13, 0, 0}, {8, 6, 21, 23, 25, 0}, {0, 31, 4, 33, 35, 2}, {41, 0, 2, 0, 4, 43}};
  const std::vector<std::vector<int>> after{
      {0, 11, 13, 0, 0, 0}, {8, 21, 23, 25, 6, 0}, {31, 0, 33, 35, 4, 2}, {41, 0, 2, 0, 43, 4}};
  const std::vector<std::string> falling{"001100", "001110", "010110", "000001"};
  const state::Grid grid{4, 6, 1};
  for (const int lanes : {1, 2, 4, 8}) {
    state::Volume volume(grid), wanted(grid);
    state::BitPlane falls(grid);
    for (int x = 0; x < grid.x; ++x) {
      put_column(volume, x, before[static_cast<std::size_t>(x)]);
      put_column(wanted, x, after[static_cast<std::size_t>(x)]);
      for (int y = 0; y < grid.y; ++y)
        falls.set(x, y, 0, falling[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)] == '1');
    }
    StageRun run{2, 0, 0};
    const Design design = design_of(grid, lanes);
    EXPECT_EQ(worlds::difference(wanted, run_fall(design, make_stage, falls, volume, run)), "") << lanes;
    EXPECT_EQ(run.cycles, design.shape.tokens() + 3) << "a token a cycle, a lag of one, and two channels";
  }
}

struct World {
  state::Volume before, after;
  state::BitPlane falls;
};

// Random cells that are no wall, no bottom of a column and stand on no wall fall. A loop of its own turns
// their columns.
World random_world(worlds::Random& random, const Design& design) {
  const state::Grid grid = design.shape.grid;
  World world{worlds::hostile_volume(random, design.parameters, grid), {}, state::BitPlane(grid)};
  state::Volume& v = world.before;
  v.material = state::Field<std::uint8_t>(grid);
  worlds::for_each(worlds::whole(grid), [&](int x, int y, int z) {
    if (v.solid.test(x, y, z)) v.material[v.at(x, y, z)] = static_cast<std::uint8_t>(random.below(16));
  });
  world.after = v;
  const auto copy = [&](int x, int from, int to, int z) {
    const state::Slot a = v.at(x, from, z), b = v.at(x, to, z);
    world.after.solid.set(x, to, z, v.solid.test(x, from, z));
    world.after.liquid.set(x, to, z, v.liquid.test(x, from, z));
    world.after.amount[b] = v.amount[a];
    world.after.energy[b] = v.energy[a];
    world.after.heat[b] = v.heat[a];
    world.after.material[b] = v.material[a];
  };
  worlds::for_each(worlds::whole(grid), [&](int x, int y, int z) {
    if (y == 0 || v.inert.test(x, y, z) || v.inert.test(x, y - 1, z) || random.one_in(2)) return;
    world.falls.set(x, y, z, true);
  });
  for (int z = 0; z < grid.z; ++z)
    for (int x = 0; x < grid.x; ++x)
      for (int y = 1; y < grid.y; ++y) {
        if (!world.falls.test(x, y, z)) continue;
        int below = y - 1;
        while (world.falls.test(x, below, z)) --below;
        copy(x, y, y - 1, z);
        if (y + 1 == grid.y || !world.falls.test(x, y + 1, z)) copy(x, below, y, z);
      }
  return world;
}

TEST(PiecesStage, RandomColumnsUnderStalls) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    worlds::Random random(seed * 31 + 5);
    const state::Grid grid{random.between(1, 19), random.between(1, 9), random.between(1, 5)};
    const Design design = design_of(grid, random.any({1, 2, 4, 8, 16}));
    const World world = random_world(random, design);
    StageRun run{random.any({1, 2, 5}), random.one_in(2) ? 0 : seed + 1, 0};
    ASSERT_EQ(worlds::difference(world.after, run_fall(design, make_stage, world.falls, world.before, run)),
              "")
        << "world " << seed;
  }
}

TEST(PiecesStage, HoldsOneCellALaneAndOnlyWherePiecesFall) {
  Design design = design_of({9, 7, 5}, 4);
  const std::unique_ptr<Stage> stage = make_stage(StageKind::fall, design);
  ASSERT_EQ(stage->buffers().size(), 1u);
  EXPECT_EQ(stage->buffers().front().total(), 4 * (2 + 16 + 16 + 16)) << "state, amount, energy, heat";
  EXPECT_EQ(stage->lag(), 1);
  EXPECT_EQ(lag_of(StageKind::fall, design).tokens(design.shape), 1);
  EXPECT_EQ(lag_of(StageKind::fall, design).reach, 0);
  EXPECT_EQ(stage->units().multipliers + stage->units().dividers, 0);
  EXPECT_EQ(stages_of_step(design).front(), StageKind::fall);
  const auto feeds_of = [](const Design& one) {
    int feeds = 0;
    for (const StageReport& report : Pipeline(one.parameters, one.shape.grid, {4, 2}).stages())
      feeds += report.kind == StageKind::fall_feed ? 1 : 0;
    return feeds;
  };
  EXPECT_EQ(feeds_of(design), 1) << "the first time step has it";
  design.parameters.pieces.fall = false;
  EXPECT_NE(stages_of_step(design).front(), StageKind::fall);
  EXPECT_EQ(feeds_of(design), 0);
}

TEST(PiecesStage, WorksOnlyInPassesInWhichSomethingFalls) {
  Pass pass;
  EXPECT_FALSE(pass.uses(StageKind::fall, 0));
  pass.falls = true;
  EXPECT_TRUE(pass.uses(StageKind::fall, 0));
  pass.substeps = 3;
  pass.substep = 1;
  EXPECT_FALSE(pass.uses(StageKind::fall, 0)) << "pieces fall before the first sub-step";
}

// The first cell that differs must be the one that the fault names.
TEST(PiecesStage, EachFaultMakesTheCellWrongThatItNames) {
  for (const Fault fault : {Fault::fall_not_passed, Fault::fall_late, Fault::fall_lane,
                            Fault::fall_below_lost, Fault::fall_heat_stays, Fault::fall_material_stays}) {
    int struck = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      worlds::Random random(seed * 37 + 11);
      const Design design = design_of({random.between(2, 12), random.between(3, 9), 3}, random.any({2, 4}));
      const World world = random_world(random, design);
      FaultPlan plan(fault, 0);
      StageRun run{2, 0, 0};
      const state::Volume result = run_fall(design, planted_stages(plan), world.falls, world.before, run);
      if (!plan.struck()) continue;
      ++struck;
      std::string first;
      std::vector<Cell> is(static_cast<std::size_t>(design.shape.lanes)), wanted(is);
      for (Place place; place.ordinal < design.shape.tokens() && first.empty(); place.next(design.shape)) {
        read_token(result, design.shape, place, is.data());
        read_token(world.after, design.shape, place, wanted.data());
        for (std::size_t lane = 0; lane < is.size() && first.empty(); ++lane)
          if (is[lane] != wanted[lane])
            first = std::to_string(place.x + static_cast<int>(lane)) + ", " + std::to_string(place.y) + ", " +
                    std::to_string(place.z);
      }
      const StruckCell& named = *plan.struck();
      ASSERT_EQ(first,
                std::to_string(named.x) + ", " + std::to_string(named.y) + ", " + std::to_string(named.z))
          << static_cast<int>(fault) << ", seed " << seed;
    }
    EXPECT_GE(struck, 10) << static_cast<int>(fault);
  }
}

}  // namespace
}  // namespace voxmelt::hwmodel
