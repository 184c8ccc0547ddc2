// What every stage does, whatever its rule: it loses nothing under stalls, and every cycle of it is counted.
#include "tests/hwmodel/stage_run.h"

namespace voxmelt::hwmodel {
namespace {

// Hands cells on, `lag` tokens late.
class Late final : public Stage {
 public:
  Late(const Design& design, std::int64_t lag)
      : Stage("late", "melt", design, lag), line_(design.shape.lanes, static_cast<std::size_t>(lag)) {}

 protected:
  void advance(const Cell* in, Cell* out) override {
    line_.shift();
    if (in != nullptr) std::copy(in, in + lanes(), line_.tap(0));
    if (out != nullptr) std::copy_n(line_.tap(line_.delay()), lanes(), out);
  }

 private:
  TapLine<Cell> line_;
};

TEST(StageAccount, NothingIsLostAndCyclesSum) {
  int runs = 0;
  for (const int lanes : {1, 2, 4, 16})
    for (const int depth : {1, 2, 7})
      for (const std::uint64_t seed : {0u, 1u, 2u})
        for (const int lag : {0, 1, 13}) {
          worlds::Random random(static_cast<std::uint64_t>(lanes * 100 + depth));
          const state::Grid grid{random.between(1, 20), random.between(1, 9), random.between(1, 5)};
          rule::Parameters parameters = worlds::hostile_parameters(random, rule::Law::paper, grid);
          const state::Volume volume = worlds::hostile_volume(random, parameters, grid);
          const Design design{parameters, {grid, lanes}};
          Stages stages;
          for (int i = 0; i < 3; ++i) stages.push_back(std::make_unique<Late>(design, lag));
          StageRun run{depth, seed};
          const state::Volume result = run_stages(design, stages, 0, nullptr, nullptr, volume, run);
          ASSERT_EQ(worlds::difference(volume, result), "");
          if (seed == 0) {
            const std::int64_t interval = depth == 1 ? 2 : 1, hops = 4;
            ASSERT_EQ(run.cycles, interval * (design.shape.tokens() - 1 + 3 * lag) + hops + 1)
                << lanes << " lanes, depth " << depth << ", lag " << lag;
          }
          ++runs;
        }
  EXPECT_EQ(runs, 108);
}

}  // namespace
}  // namespace voxmelt::hwmodel
