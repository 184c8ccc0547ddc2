// In calm worlds nearly everything sleeps, and small causes wake it. A vent or a drain opens, heat arrives,
// light moves, a wall melts, or liquid falls or is pushed up beyond the tiles that are awake. The bits must
// be the reference's after every phase, with the smallest tiles.
#include <algorithm>
#include <cstdint>

#include "tests/kernel/engine/parallel/calm.h"
#include "tests/kernel/engine/parallel/equal.h"
#include "tests/rounds.h"

namespace voxmelt::parallel {
namespace {

using namespace worlds;

step::Tuning sleepy(int threads, int tile_shift) {
  return {.threads = threads, .sleep = true, .tile_shift = tile_shift};
}

class Calm : public testing::TestWithParam<rule::Law> {};

TEST_P(Calm, SleepersWakeInTime) {
  for (int seed = 0; seed < rounds(250); ++seed) {
    Random random(seed * 104729 + static_cast<std::uint64_t>(GetParam()));
    const Grid grid = calm_grid(random);
    const Parameters parameters = calm_parameters(random, GetParam(), grid);
    const Volume start = calm_volume(random, parameters, grid);
    const step::Tuning tuning = sleepy(random.between(1, 3), random.any({0, 0, 1, 2}));
    if (!same_steps(parameters, start, fast_implementations().back(), tuning, 30))
      FAIL() << "seed " << seed << ", grid " << grid.x << " x " << grid.y << " x " << grid.z;
  }
}

// Tells if a tile of this slice or of the next ones is awake, in any row: columns settle as a whole. Each of
// up to four passes of heat wakes one more slice.
bool awake_near(const step::AwakeTiles& awake, Grid g, int z) {
  for (int near = std::max(0, z - 4); near <= std::min(g.z - 1, z + 4); ++near)
    for (int y = 0; y < g.y; ++y)
      for (int x = 0; x < g.x; x += 64)
        if (awake.test(x, y, near)) return true;
  return false;
}

// Whoever looks at a run between two steps is told what sleeps.
TEST_P(Calm, NothingChangesFarFromTilesThatAreToldToBeAwake) {
  int asleep = 0, changed = 0;
  for (int seed = 0; seed < rounds(120); ++seed) {
    Random random(seed * 7919 + static_cast<std::uint64_t>(GetParam()));
    const Grid grid{random.between(3, 66), random.between(3, 9), random.between(17, 40)};
    Parameters parameters = calm_parameters(random, GetParam(), grid);
    parameters.heat.radiation = parameters.open_border = false;
    parameters.heat.sources.clear();
    parameters.vents.clear();
    parameters.drains.clear();
    parameters.pieces = {};
    run::Simulation simulation(parameters, calm_volume(random, parameters, grid),
                               *run::implementations().find(fast_implementations().back()),
                               sleepy(1, random.any({0, 1, 2})));
    for (int step = 0; step < 12; ++step) {
      const step::AwakeTiles awake = simulation.awake();
      const Volume before = simulation.volume();
      simulation.step();
      for_each(whole(grid), [&](int x, int y, int z) {
        if (!awake.test(x, y, z)) ++asleep;
        if (state::same_cell(before, simulation.volume(), x, y, z)) return;
        ++changed;
        ASSERT_TRUE(awake_near(awake, grid, z)) << "seed " << seed << ", step " << step << ", slice " << z;
      });
    }
  }
  EXPECT_GT(asleep, rounds(30000));
  EXPECT_GT(changed, rounds(30000));
}

INSTANTIATE_TEST_SUITE_P(Laws, Calm, testing::Values(rule::Law::paper, rule::Law::viscous),
                         [](const auto& chosen) {
                           return chosen.param == rule::Law::paper ? "paper" : "viscous";
                         });

}  // namespace
}  // namespace voxmelt::parallel
