// When a run settles, its heat moves (docs/automaton.md, section 10). Expected values are worked out by hand.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <vector>

#include "kernel/engine/scalar/reference.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::scalar {
namespace {

using namespace worlds;
using step::Phase;

struct Held {
  std::int32_t amount, heat;
  bool operator==(const Held&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Held& held) {
  return out << held.amount << " at " << held.heat;
}
using Column = std::vector<Held>;

Parameters with_heat() {
  Parameters p = viscous(0.02);
  p.heat.enabled = true;
  return p;
}

Volume column_of(const Column& cells, int height) {
  Volume v(Grid{1, height, 1});
  for (std::size_t y = 0; y < cells.size(); ++y)
    put(v, 0, static_cast<int>(y), 0, cells[y].amount, 0, cells[y].heat);
  return v;
}

struct Settled {
  Column cells;
  state::Sum rounded;
};

// Settles a column of the grid's height at step s. The dithers are D(0) = 0, D(1) = 32768, D(3) = 49152.
Settled settle(const Column& cells, int height, std::uint32_t s = 0) {
  Volume v = column_of(cells, height);
  state::Ledger ledger = state::Ledger::open(v);
  Reference(with_heat(), v.grid).run(Phase::excess, step::Moment(s), nullptr, v, ledger);
  EXPECT_TRUE(state::drift(ledger, v).none());
  Column after;
  for (int y = 0; y < height; ++y) after.push_back({v.amount[v.at(0, y, 0)], v.heat[v.at(0, y, 0)]});
  return {after, ledger.heat.rounded};
}

TEST(Settle, ARunAtRestKeepsEveryHeatAtEveryStep) {
  const Column rest{{4096, 100}, {4096, 201}, {2000, 65535}, {0, 0}};
  for (std::uint32_t s = 0; s < 8; ++s) {
    EXPECT_EQ(settle(rest, 4, s).cells, rest);
    EXPECT_EQ(settle(rest, 4, s).rounded, 0);
  }
}

TEST(Settle, WhatIsTooMuchMovesUpAndMixesWhereItArrives) {
  // 2048 at 1000 come to 1024 at 4001: 6145024 / 3072 = 2000.33.
  const Column column{{6144, 1000}, {1024, 4001}};
  EXPECT_EQ(settle(column, 4, 0).cells, (Column{{4096, 1000}, {3072, 2000}, {0, 0}, {0, 0}}));
  EXPECT_EQ(settle(column, 4, 0).rounded, -1024);
  EXPECT_EQ(settle(column, 4, 3).cells, (Column{{4096, 1000}, {3072, 2001}, {0, 0}, {0, 0}}));
  EXPECT_EQ(settle(column, 4, 3).rounded, 2048);
}

TEST(Settle, UpwardFlowsFollowEachOtherFromTheBottom) {
  // 8192 at 1000 come to 2048 at 5000: 1800. 6144 of these come to 1024 at 9000: 2828.57. 3072 of these go
  // into air.
  EXPECT_EQ(settle({{12288, 1000}, {2048, 5000}, {1024, 9000}}, 5).cells,
            (Column{{4096, 1000}, {4096, 1800}, {4096, 2828}, {3072, 2828}, {0, 0}}));
}

TEST(Settle, DownwardFlowsFollowEachOtherFromTheTop) {
  // 2048 at 5000 come to 4096 at 3000: 3666.67. 2048 of these come to 2048 at 1000: 2333.
  EXPECT_EQ(settle({{2048, 1000}, {4096, 3000}, {4096, 5000}}, 3).cells,
            (Column{{4096, 2333}, {4096, 3666}, {2048, 5000}}));
}

TEST(Settle, FlowsUpBelowAndDownAboveInOneRun) {
  // 2048 at 1000 go up to 2048 at 2000: 1500. 2048 at 7000 go down to 2048 at 3000: 5000.
  EXPECT_EQ(settle({{6144, 1000}, {2048, 2000}, {2048, 3000}, {4096, 7000}}, 4).cells,
            (Column{{4096, 1000}, {4096, 1500}, {4096, 5000}, {2048, 7000}}));
}

// 1024 at 1001 go up to 2048 at 1000: 1000.33. Then 1024 at 1003 go down to these 3072 at 1000: 1000.75. The
// other way round it would be 1001.
TEST(Settle, UpComesBeforeDownIntoOneCell) {
  EXPECT_EQ(settle({{5120, 1001}, {2048, 1000}, {4096, 1003}}, 3).cells,
            (Column{{4096, 1001}, {4096, 1000}, {3072, 1003}}));
}

TEST(Settle, ATopThatEmptiesLeavesTheRun) {
  EXPECT_EQ(settle({{2048, 1000}, {1024, 4000}}, 3).cells, (Column{{3072, 2000}, {0, 0}, {0, 0}}));
}

TEST(Settle, UnderPressureARunMixes) {
  // The mean is (8192 x 1000 + 4096 x 3000) / 12288 = 1666.67.
  EXPECT_EQ(settle({{8192, 1000}, {4096, 3000}}, 2).cells, (Column{{4096, 1666}, {8192, 1666}}));
  EXPECT_EQ(settle({{8192, 1000}, {4096, 3000}}, 3).cells, (Column{{4096, 1000}, {4096, 2000}, {4096, 2000}}))
      << "a lid higher";
}

// 61439 beyond ONE in each of the two lowest cells is the most that keeps the order.
TEST(Settle, AnExcessOfMoreThanFifteenCellsMixes) {
  const Settled most = settle({{61440, 1000}, {8191, 2000}}, 20);
  // 57344 at 1000 come to 8191 at 2000: 1124.98.
  EXPECT_EQ(most.cells[0], (Held{4096, 1000}));
  for (std::size_t y = 1; y < 16; ++y) EXPECT_EQ(most.cells[y], (Held{4096, 1124})) << y;
  EXPECT_EQ(most.cells[16], (Held{4095, 1124}));
  // The mean is (61440 x 1000 + 8192 x 2000) / 69632 = 1117.65.
  const Settled more = settle({{61440, 1000}, {8192, 2000}}, 20);
  for (std::size_t y = 0; y < 17; ++y) EXPECT_EQ(more.cells[y], (Held{4096, 1117})) << y;
  EXPECT_EQ(settle({{65535, 1000}}, 20).cells[15], (Held{4095, 1000})) << "the most that a cell may hold";
}

TEST(Settle, AShortageOfMoreThanFifteenCellsMixes) {
  Column column(31, {2048, 2000});
  column[0] = {2049, 1000};
  column[30] = {1, 2000};
  const Settled most = settle(column, 31);
  // 2047 at 2000 come to 2049 at 1000: 1499.76.
  EXPECT_EQ(most.cells[0], (Held{4096, 1499}));
  for (std::size_t y = 1; y < 15; ++y) EXPECT_EQ(most.cells[y], (Held{4096, 2000})) << y;
  EXPECT_EQ(most.cells[15], (Held{2, 2000}));
  column[0].amount = 2048;
  // The mean is 2000 - 2048 x 1000 / 61441 = 1966.67.
  const Settled more = settle(column, 31);
  for (std::size_t y = 0; y < 15; ++y) EXPECT_EQ(more.cells[y], (Held{4096, 1966})) << y;
  EXPECT_EQ(more.cells[15], (Held{1, 1966}));
}

// A shortage above the highest face does not count, as the last cell has no face above it.
TEST(Settle, TheTopOfARunHasNoFace) {
  Column column(31, {2048, 2000});
  column[0] = {2049, 1000};
  column[30] = {2048, 2000};
  EXPECT_EQ(settle(column, 31).cells[0], (Held{4096, 1499}));
}

// Hot liquid lies above cold. One step of settling carries heat as far as liquid flows, not to the bottom.
TEST(Settle, LayersStayLayers) {
  Random random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    Column column;
    std::int32_t heat = 0;
    for (int n = random.between(1, 20); n > 0; --n)
      column.push_back({random.between(2048, 6000), heat = random.between(heat, 65535)});
    const Settled settled = settle(column, 40, static_cast<std::uint32_t>(random.below(65536)));
    std::int32_t below = 0;
    for (const Held& cell : settled.cells) {
      if (cell.amount == 0) break;
      ASSERT_GE(cell.heat, below);
      below = cell.heat;
    }
    ASSERT_LE(below, heat);
  }
}

// Two cells of 2047 and 2048 have the mean 2047.5, which is 2047 whatever the dither. A degree has 512/65536
// octaves, so the flow of 191.8 (raw is 2095054, c 1047527 and the drive 12288) is one less below 2048.
TEST(Settle, MobilityGoesByTheMeanWithoutDither) {
  Parameters p = with_heat();
  p.flow.thermal_viscosity = true;
  p.flow.viscous.mobility = 134083510;
  p.flow.mobility_reference = 2048;
  p.flow.mobility_rate = 32767;
  const auto flow = [&](std::uint16_t lower, std::uint16_t upper, std::uint32_t s) {
    Volume v(Grid{2, 2, 1});
    put(v, 0, 0, 0, 4096, 0, lower);
    put(v, 0, 1, 0, 4096, 0, upper);
    state::Ledger ledger = state::Ledger::open(v);
    Reference reference(p, v.grid);
    reference.run(Phase::excess, step::Moment(s), nullptr, v, ledger);
    reference.run(Phase::spread, step::Moment(s), nullptr, v, ledger);
    return int{v.amount[v.at(1, 0, 0)]};
  };
  for (std::uint32_t s = 0; s < 4; ++s) {
    const int cold = flow(2047, 2047, s), warm = flow(2048, 2048, s);
    EXPECT_LT(cold, warm) << "step " << s;
    EXPECT_EQ(flow(2047, 2048, s), cold) << "step " << s;
    EXPECT_EQ(flow(2047, 2049, s), warm) << "step " << s;
  }
}

}  // namespace
}  // namespace voxmelt::scalar
