// The table of operations is held against all numbers of its source, and a token is worked by hand.
#include "hwmodel/explore/operation_energy.h"

#include <gtest/gtest.h>

#include <vector>

namespace voxmelt::hwmodel::explore {
namespace {

// M. Horowitz, ISSCC 2014, figure 1.1.9: integer additions and products, and reads of 64 bits from a cache.
TEST(OperationEnergy, IsThatOfItsSource) {
  EXPECT_NEAR(energy_of_addition(8), 0.03, 0.006);
  EXPECT_NEAR(energy_of_addition(32), 0.1, 1e-9);
  EXPECT_NEAR(energy_of_product(8, 8), 0.2, 0.01);
  EXPECT_NEAR(energy_of_product(32, 32), 3.1, 1e-9);
  EXPECT_NEAR(energy_of_access(64, 8.0 * 8 * 1024), 10, 1e-9);
  EXPECT_NEAR(energy_of_access(64, 8.0 * 32 * 1024), 20, 1e-9);
  EXPECT_NEAR(energy_of_access(64, 8.0 * 1024 * 1024), 100, 14);
}

// Two lanes of a stage with 320 LUTs, a divider of 640 and a product of 32 by 16, and a block for 8 lanes of
// 3200. Its buffer has 4096 words of 2 x 8 bits, which are 8 KiB: a word takes 2.5 pJ to write, and to read.
TEST(OperationEnergy, ATokenWorkedByHand) {
  Family family;
  family.divider.lut.value = 640;
  family.random_block.lut.value = 3200;
  family.stages[StageKind::melt] = {{{320}, {}}, {{32, 16}}};
  const Units units{.multipliers = 3, .dividers = 1, .random_blocks = 1};
  const std::vector<BufferCost> buffers{{"line", 4096, 2, 8}};
  const OperationEnergy token = energy_of_token(StageKind::melt, units, buffers, 2, family);
  EXPECT_NEAR(token.add, 1 + 1 + 2 * 2 + 10, 1e-9);  // 0.1 pJ each 32 bits
  EXPECT_NEAR(token.multiply, 2 * 3 * 1.55, 1e-9);
  EXPECT_NEAR(token.buffer, 2 * 2.5, 1e-9);
  EXPECT_EQ(energy_of_token(StageKind::writer, {}, {}, 2, family).all(), 0) << "it only hands on";

  VerifyReport report;
  report.stages.resize(2);
  report.stages[0].kind = report.stages[1].kind = StageKind::melt;
  report.stages[0].units = report.stages[1].units = units;
  report.stages[0].buffers = buffers;
  report.stages[0].cycles.busy = 10;
  report.stages[1].cycles.busy = 3;
  report.stages[1].cycles.starved = 100;
  const OperationEnergy run = energy_of_run(report, 2, family);
  EXPECT_NEAR(run.add, 13 * 16, 1e-9);
  EXPECT_NEAR(run.multiply, 13 * 9.3, 1e-9);
  EXPECT_NEAR(run.buffer, 10 * 5, 1e-9);
}

}  // namespace
}  // namespace voxmelt::hwmodel::explore
