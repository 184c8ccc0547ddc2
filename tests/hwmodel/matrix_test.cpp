// The full matrix of docs/hardware.md (slow): whole showcase scenes in the middle of their melt over the
// covering array, and the full product on crops of 24 cells. Prints a line per scene.
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>

#include "tests/hwmodel/lockstep_world.h"

namespace voxmelt::hwmodel {
namespace {

class Matrix : public testing::TestWithParam<std::pair<std::string, std::uint32_t>> {};

TEST_P(Matrix, WholeScene) {
  const Start start = start_of(GetParam().first, GetParam().second);
  ASSERT_GT(start.volume.liquid.count(), 1000);
  const rule::Flow& flow = start.parameters.flow;
  const bool single = flow.law == rule::Law::paper || flow.viscous.substeps == 1;
  const std::uint32_t steps = single ? 10 : 3;  // a step with sub-steps is several passes
  std::int64_t compared = 0;
  for (const Configuration& c : covering_array()) {
    const VerifyReport report = lockstep(start, c, steps);
    ASSERT_EQ(report.mismatch, nullptr) << name_of(c) << ":\n" << text_of(*report.mismatch);
    const double off = 100.0 * static_cast<double>(report.cycles - report.predicted_cycles) /
                       static_cast<double>(report.predicted_cycles);
    std::printf("| %s | %d..%d | %d | %d | %d | %d | %lld | 0 | %lld | %+.2f %% | %.2f |\n",
                start.name.c_str(), static_cast<int>(start.step), static_cast<int>(start.step + steps),
                c.lanes, c.cascade, c.fifo_depth, static_cast<int>(c.stall_seed),
                static_cast<long long>(report.compared_cells), static_cast<long long>(report.cycles), off,
                1e-6 * static_cast<double>(report.cell_steps) / report.model_seconds);
    std::fflush(stdout);
    if (c.stall_seed == 0) {
      EXPECT_EQ(report.cycles, report.predicted_cycles);
    }
    compared += report.compared_cells;
  }
  EXPECT_GT(compared, 9 * 3 * steps * static_cast<std::int64_t>(start.volume.grid.cells()));
}

TEST_P(Matrix, FullProductOnACrop) {
  const Start start = crop(start_of(GetParam().first, GetParam().second), 24);
  int runs = 0;
  for (const Configuration& c : full_product()) {
    ASSERT_TRUE(agrees(start, c, 10));
    ++runs;
  }
  EXPECT_EQ(runs, 54);
}

INSTANTIATE_TEST_SUITE_P(Showcase, Matrix, testing::ValuesIn(showcase()),
                         [](const auto& chosen) { return chosen.param.first; });

}  // namespace
}  // namespace voxmelt::hwmodel
