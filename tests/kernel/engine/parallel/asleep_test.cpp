// Tiles that rest cost nothing: for a flat pool the paper law's kernels are not even called. Other tests
// check that sleeping tiles have the right bits. This one checks that tiles sleep.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "kernel/automaton/rule/random.h"
#include "kernel/engine/parallel/paper_flow.h"
#include "kernel/engine/parallel/walls.h"
#include "tests/kernel/engine/parallel/equal.h"
#include "tests/kernel/engine/simd/heat_driver.h"

namespace voxmelt::parallel {
namespace {

using namespace worlds;

simd::Kernels counted;
int calls = 0;

void gravity(const simd::View& v, const simd::Step& s, int z, int r, TileRow work, TileRow& follow,
             TileRow* changed, simd::Books& books) {
  ++calls;
  counted.gravity(v, s, z, r, work, follow, changed, books);
}
TileRow pattern(const simd::View& v, const simd::Step& s, int z, int r, TileRow work,
                const std::uint64_t* below, simd::Gifts& gifts) {
  ++calls;
  return counted.pattern(v, s, z, r, work, below, gifts);
}
TileRow apply(const simd::View& v, const simd::Step& s, int z, int r, const simd::Gifts& below,
              const simd::Gifts& own, const simd::Gifts& above, simd::Books& books) {
  ++calls;
  return counted.apply(v, s, z, r, below, own, above, books);
}

// Counts the calls of the kernels in each of some steps.
std::vector<int> calls_of_steps(cpu::InstructionSet set, const Parameters& parameters, Volume volume,
                                int steps) {
  counted = simd::kernels(set, parameters);
  simd::Kernels kernels = counted;
  kernels.gravity = gravity;
  kernels.pattern = pattern;
  kernels.apply = apply;
  simd::View view = simd::view_of(volume, simd::View{}.tile_shift);
  const Walls walls(view);
  view.walls = view.sides = walls.origin(view);
  PaperFlow flow(parameters, view, 1);
  cpu::Workers workers(1);
  const rule::RoundKeys keys = rule::round_keys(parameters.seed);
  Tiles dirty(view.nz, view.tile_rows()), next = dirty;
  dirty.fill(all_words(view));
  simd::Books books;
  std::vector<int> result;
  for (int s = 0; s < steps; ++s) {
    calls = 0;
    const simd::Step step{&parameters, static_cast<std::uint32_t>(s),
                          static_cast<std::uint32_t>(rule::dither(static_cast<std::uint32_t>(s))),
                          keys.data(), nullptr};
    const Job job{view, step, kernels, workers, true};
    flow.gravity(job, dirty, books);
    flow.spread(job, dirty, next, books);
    std::swap(dirty, next);
    result.push_back(calls);
  }
  return result;
}

class Asleep : public testing::TestWithParam<cpu::InstructionSetRow> {};

// The pool has energy to spread, and nowhere to spread to: every cell is full, and its neighbours are.
TEST_P(Asleep, FlatPoolsCallNoKernel) {
  if (!cpu::supported(GetParam().set)) GTEST_SKIP() << "not on this processor";
  for (const int neighbours : {4, 8})
    for (const int width : {3, 64, 100, 130}) {
      Parameters p = paper_showcase();
      p.flow.paper.neighbours = neighbours;
      Volume pool({width, 20, 6});
      for_each(whole(pool.grid), [&](int x, int y, int z) {
        if (y < 11) put(pool, x, y, z, kOne, kOne);
      });
      const std::vector<int> called = calls_of_steps(GetParam().set, p, pool, 4);
      EXPECT_GT(called[0], 0) << "nothing is known about the first state";
      EXPECT_EQ(called[2], 0) << neighbours << " neighbours, " << width << " wide";
      EXPECT_EQ(called[3], 0);
      // One cell is too full. It wakes only its surroundings.
      put(pool, width / 2, 10, 3, 3 * kOne, kOne);
      EXPECT_GT(calls_of_steps(GetParam().set, p, pool, 4)[2], 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Sets, Asleep, testing::ValuesIn(cpu::kInstructionSets), [](const auto& set) {
  std::string name(set.param.name);
  std::erase(name, '.');
  return name;
});

}  // namespace
}  // namespace voxmelt::parallel
