// In whole steps nobody looks between the phases. So gravity may run a slice ahead of spread, in bands of
// tile rows. After every step the state and the books must be the reference's, on worlds that are full,
// nearly full in some slices, and thin.
#include <cstdint>
#include <string>

#include "tests/kernel/engine/parallel/equal.h"
#include "tests/rounds.h"

namespace voxmelt::parallel {
namespace {

using namespace worlds;

// Returns a grid that is taller than a band, or has slices enough for several chunks, or both.
Grid tall_grid(Random& random) {
  const int kind = random.below(3);
  if (kind == 0) return {random.any({5, 63, 64, 130}), random.between(30, 100), random.between(1, 6)};
  if (kind == 1) return {random.between(3, 20), random.between(1, 12), random.between(8, 40)};
  return {random.between(3, 40), random.between(33, 70), random.between(6, 14)};
}

step::Tuning any_tuning(Random& random) {
  step::Tuning tuning;
  tuning.threads = random.between(1, 4);
  tuning.sleep = !random.one_in(3);
  tuning.tile_shift = random.any({0, 1, 3, 3, 4, 5, 12});
  tuning.ahead_from = random.one_in(6) ? 1000 : 0;
  return tuning;
}

// Makes every cell liquid that may be, so that it moves.
void fill_up(Random& random, Volume& v, int z_begin, int z_end) {
  for_each({0, 0, z_begin, v.grid.x, v.grid.y, z_end}, [&](int x, int y, int z) {
    if (v.solid.test(x, y, z) || v.inert.test(x, y, z)) return;
    const std::int32_t amount = random.between(1, 2 * rule::kOne);
    put(v, x, y, z, amount, random.between(0, amount));
  });
}

bool same_whole_steps(const Parameters& parameters, const Volume& start, const std::string& name,
                      const step::Tuning& tuning, int count, Random& random) {
  run::Simulation expected(parameters, start, implementation("reference"));
  run::Simulation actual(parameters, start, implementation(name), tuning);
  Volume before = start;
  state::ChangedBricks::Seen seen = actual.volume().changed.now();
  for (int step = 0; step < count; ++step) {
    expected.step();
    if (random.one_in(4)) {  // the state is read between the phases
      actual.begin_step();
      for (const step::Phase phase : actual.phases()) actual.run_phase(phase);
      actual.end_step();
    } else {
      actual.step();
    }
    std::string found = difference(expected.volume(), actual.volume());
    if (const std::string change = untold(before, seen, actual.volume()); !change.empty())
      found += " untold: " + change;
    before = actual.volume();
    seen = actual.volume().changed.now();
    if (found.empty() && expected.ledger() == actual.ledger()) continue;
    ADD_FAILURE() << name << ", threads " << tuning.threads << ", tile_shift " << tuning.tile_shift
                  << ", sleep " << tuning.sleep << ", step " << step << ": "
                  << (found.empty() ? "the books differ" : found);
    return false;
  }
  return true;
}

class Ahead : public testing::TestWithParam<std::string> {};

TEST_P(Ahead, SameBitsAfterEveryStep) {
  for (int seed = 0; seed < rounds(150); ++seed) {
    Random random(seed * 7321 + 5);
    const Grid grid = tall_grid(random);
    Parameters parameters = hostile_parameters(random, rule::Law::paper, grid);
    may_freeze(random, parameters);
    if (!random.one_in(3)) parameters.heat = {};
    if (random.one_in(2)) parameters.flow.fall = {};
    Volume start = hostile_volume(random, parameters, grid);
    if (random.one_in(4)) thin_out(random, start);
    if (!parameters.heat.enabled && random.one_in(2)) {
      const int from = random.one_in(2) ? 0 : random.below(grid.z);
      fill_up(random, start, from, grid.z);
    }
    if (!same_whole_steps(parameters, start, GetParam(), any_tuning(random), 7, random))
      FAIL() << "seed " << seed << ", grid " << grid.x << " x " << grid.y << " x " << grid.z;
  }
}

INSTANTIATE_TEST_SUITE_P(Implementations, Ahead, testing::ValuesIn(fast_implementations()),
                         [](const auto& one) {
                           std::string name;
                           for (const char c : one.param) name += c == '.' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace voxmelt::parallel
