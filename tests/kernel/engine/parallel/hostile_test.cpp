// Every instruction set gives the bits of the reference, with threads and tiles of any size, asleep or not.
// The states are random and hostile, and the grids straddle words and tiles.
#include <cstdint>
#include <string>
#include <tuple>

#include "tests/kernel/engine/parallel/equal.h"
#include "tests/rounds.h"

namespace voxmelt::parallel {
namespace {

using namespace worlds;

Grid any_grid(Random& random) {
  const int kind = random.below(4);
  if (kind == 0)
    return {random.any({1, 2, 31, 32, 33, 63, 64, 65, 127, 129, 200}), random.between(1, 5),
            random.between(1, 5)};
  if (kind == 1)
    return {random.between(1, 70), random.any({1, 2, 7, 8, 9, 16, 17, 40}), random.between(1, 3)};
  if (kind == 2) return {random.between(1, 12), random.between(1, 6), random.any({1, 4, 7, 8, 9, 16, 33})};
  return {random.between(3, 24), random.between(3, 24), random.between(3, 24)};
}

step::Tuning any_tuning(Random& random) {
  step::Tuning tuning;
  tuning.threads = random.between(1, 3);
  tuning.sleep = !random.one_in(3);
  tuning.tile_shift = random.any({0, 1, 3, 5, 12});
  return tuning;
}

class Hostile : public testing::TestWithParam<std::tuple<rule::Law, std::string>> {};

TEST_P(Hostile, SameBitsAfterEveryPhase) {
  const auto& [law, name] = GetParam();
  for (int seed = 0; seed < rounds(700); ++seed) {
    Random random(seed * 7919 + (law == rule::Law::paper ? 1 : 2));
    const Grid grid = any_grid(random);
    Parameters parameters = hostile_parameters(random, law, grid);
    may_freeze(random, parameters);
    if (seed % 3 == 0) parameters.flow.viscous.stages_max = random.any<std::uint16_t>({2, 3, 5, 16});
    if (random.one_in(2)) parameters.heat = {};  // so that cells come to rest, and tiles sleep
    if (random.one_in(2)) {
      parameters.vents.clear();
      parameters.drains.clear();
    }
    Volume start = hostile_volume(random, parameters, grid);
    if (seed % 2 == 1) thin_out(random, start);
    may_be_of_materials(random, parameters, start);
    if (!same_steps(parameters, start, name, any_tuning(random), 6)) {
      FAIL() << "seed " << seed << ", grid " << grid.x << " x " << grid.y << " x " << grid.z;
    }
  }
}

// Every row is wider than the cells that a kernel takes at once.
TEST_P(Hostile, SameBitsOnWideGrids) {
  const auto& [law, name] = GetParam();
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Random random(seed * 6151 + (law == rule::Law::paper ? 1 : 2));
    const Grid grid{random.between(600, 2200), random.between(8, 17), random.between(1, 2)};
    Parameters parameters = hostile_parameters(random, law, grid);
    if (random.one_in(2)) parameters.flow.viscous.stages_max = random.any<std::uint16_t>({2, 3, 5, 16});
    parameters.heat.radiation = false;
    may_freeze(random, parameters);
    Volume start = hostile_volume(random, parameters, grid);
    if (seed % 2 == 1) thin_out(random, start);
    may_be_of_materials(random, parameters, start);
    step::Tuning tuning = any_tuning(random);
    tuning.tile_shift = random.any({3, 5, 12});
    if (!same_steps(parameters, start, name, tuning, 3)) {
      FAIL() << "seed " << seed << ", grid " << grid.x << " x " << grid.y << " x " << grid.z;
    }
  }
}

// The tile row is so tall that a sum over it would overflow 32 bits, as everything is pushed up.
TEST(Hostile, BooksOfTallTiles) {
  Parameters parameters = paper_showcase();
  parameters.heat.enabled = true;
  Volume start({4096, 132, 1});
  for_each(whole(start.grid), [&](int x, int y, int z) {
    put(start, x, y, z, y == 0 ? 65535 : 65534, 0, 1000 + 2000 * (y % 2));
  });
  for (const std::string& name : fast_implementations()) {
    run::Simulation expected(parameters, start, implementation("reference"));
    run::Simulation actual(parameters, start, implementation(name), {.threads = 1, .tile_shift = 12});
    for (run::Simulation* one : {&expected, &actual}) {
      one->begin_at(65535);
      one->run_phase(step::Phase::gravity);
    }
    EXPECT_EQ(difference(expected.volume(), actual.volume()), "") << name;
    EXPECT_TRUE(expected.ledger() == actual.ledger()) << name << ": the books differ";
  }
}

INSTANTIATE_TEST_SUITE_P(Implementations, Hostile,
                         testing::Combine(testing::Values(rule::Law::paper, rule::Law::viscous),
                                          testing::ValuesIn(fast_implementations())),
                         [](const auto& chosen) {
                           std::string name =
                               std::get<0>(chosen.param) == rule::Law::paper ? "paper_" : "viscous_";
                           for (const char c : std::get<1>(chosen.param)) name += c == '.' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace voxmelt::parallel
