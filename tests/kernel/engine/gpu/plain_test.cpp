// The kernels for devices, as C++, give the bits and the books of the reference in random and hostile worlds,
// on grids that straddle words and bricks.

#include "tests/kernel/engine/gpu/hostile_world.h"
#include "tests/kernel/engine/gpu/plain_device.h"
#include "tests/kernel/engine/gpu/same_steps.h"
#include "tests/rounds.h"

namespace voxmelt::gpu {
namespace {

using namespace worlds;

MakeDevice plain(int threads) {
  return [threads](const Parameters&, Grid) { return plain_device(threads); };
}

class Kernels : public testing::TestWithParam<rule::Law> {};

TEST_P(Kernels, SameBitsInHostileWorlds) {
  for (int seed = 0; seed < rounds(300); ++seed) {
    const HostileWorld world = hostile_world(seed, GetParam());
    if (!same_steps_on_device(world.parameters, world.start, plain(1 + seed % 3), 6, seed % 4 == 1))
      FAIL() << "seed " << seed;
  }
}

TEST_P(Kernels, SameBitsWhereMostBricksAreEmpty) {
  for (int seed = 0; seed < rounds(150); ++seed) {
    const HostileWorld world = sparse_world(seed, GetParam());
    if (!same_steps_on_device(world.parameters, world.start, plain(1 + seed % 3), 14, seed % 4 == 1))
      FAIL() << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, Kernels, testing::Values(rule::Law::paper, rule::Law::viscous),
                         [](const auto& law) { return law.param == rule::Law::paper ? "paper" : "viscous"; });

}  // namespace
}  // namespace voxmelt::gpu
