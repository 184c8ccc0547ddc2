// Each follower of a volume is told of its changes. In tests/kernel/engine/parallel/equal.h every change of
// every implementation must be told.
#include "kernel/automaton/state/changed_bricks.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "tests/kernel/worlds.h"

namespace voxmelt::state {
namespace {

constexpr Grid kCells{150, 17, 9};  // 19 x 3 x 2 bricks

std::vector<std::size_t> newer(const ChangedBricks& changed, const ChangedBricks::Seen& seen,
                               ChangedBricks::Part part = ChangedBricks::kMatter) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < brick_grid(kCells).cells(); ++i)
    if (changed.since(part, seen, i)) result.push_back(i);
  return result;
}

TEST(ChangedBricks, MarksTheBricksOfWords) {
  ChangedBricks changed;
  changed.follow(kCells);
  const auto seen = changed.now();
  EXPECT_TRUE(changed.none_since(seen));
  changed.new_version();
  changed.mark(ChangedBricks::kMatter, std::uint64_t{1} << 2 | std::uint64_t{1} << 40, 1,
               1);  // cells 128 to 149, and beyond the row
  EXPECT_FALSE(changed.all_since(seen) || changed.none_since(seen));
  const std::size_t row = 19 * (3 * 1 + 1);
  EXPECT_EQ(newer(changed, seen), (std::vector<std::size_t>{row + 16, row + 17, row + 18}));
  changed.new_version();
  changed.mark(ChangedBricks::kMatter, 1, 0, 0);
  EXPECT_EQ(newer(changed, seen).size(), 11u) << "changes add up";
  EXPECT_TRUE(newer(changed, changed.now()).empty());
  changed.mark(ChangedBricks::kHeat, 2, 2, 0);
  EXPECT_EQ(newer(changed, seen).size(), 11u);
  EXPECT_EQ(newer(changed, seen, ChangedBricks::kHeat).size(), 19u) << "matter takes its heat along";
  EXPECT_EQ(newer(changed, seen, ChangedBricks::kWalls).size(), 11u) << "matter counts with its walls";
  changed.mark_flow(4, 2, 1);
  EXPECT_EQ(newer(changed, seen, ChangedBricks::kWalls).size(), 11u) << "what flows moves no wall";
  EXPECT_EQ(newer(changed, seen).size(), 14u);
  changed.new_version();
  changed.mark_all();
  for (const auto part : {ChangedBricks::kMatter, ChangedBricks::kHeat, ChangedBricks::kWalls})
    EXPECT_EQ(newer(changed, seen, part).size(), brick_grid(kCells).cells());
}

TEST(ChangedBricks, WhereNobodyTellsEverythingHasChanged) {
  ChangedBricks changed;
  EXPECT_TRUE(changed.all_since({}));
  EXPECT_TRUE(changed.all_since(changed.now())) << "not followed";
  changed.follow(kCells);
  EXPECT_TRUE(changed.all_since({}));
  const auto seen = changed.now();
  const ChangedBricks copy = changed;
  EXPECT_TRUE(copy.all_since(seen)) << "a copy may be edited by hand";
  changed.begin();
  EXPECT_TRUE(changed.all_since(seen) && !changed.none_since(seen)) << "within a step";
  EXPECT_TRUE(changed.all_since(changed.now()));
  changed.end();
  EXPECT_TRUE(changed.none_since(seen));
  ChangedBricks moved = std::move(changed);
  EXPECT_TRUE(moved.none_since(seen)) << "the same volume, elsewhere";
  ChangedBricks other;
  other.follow(kCells);
  EXPECT_TRUE(other.all_since(seen)) << "another volume";
  moved.follow(kCells);
  EXPECT_TRUE(moved.all_since(seen));
  const auto again = moved.now();
  moved.forget();
  EXPECT_TRUE(moved.all_since(again));
}

TEST(ChangedBricks, AreNoPartOfTheState) {
  Volume volume(kCells);
  worlds::put(volume, 3, 4, 5, 100);
  Volume same = volume;
  same.changed.follow(kCells);
  EXPECT_TRUE(volume == same);
}

// A simulation tells of its steps, and counts all as changed that others may have changed by hand.
TEST(ChangedBricks, FollowASimulation) {
  for (const step::Implementation& implementation : run::implementations().all()) {
    if (!implementation.supported) continue;
    Volume start(kCells);
    worlds::fill_inert(start, {0, 0, 0, kCells.x, 1, kCells.z});
    worlds::fill(start, {70, 3, 1, 73, 5, 3}, 4096);
    run::Simulation simulation(worlds::paper_showcase(), start, implementation);
    const auto changed = [&]() -> const ChangedBricks& { return simulation.volume().changed; };
    EXPECT_TRUE(changed().all_since({}));
    auto seen = changed().now();
    EXPECT_TRUE(changed().none_since(seen));
    simulation.begin_step();
    EXPECT_TRUE(changed().all_since(seen)) << "within a step";
    for (const step::Phase phase : simulation.phases()) simulation.run_phase(phase);
    simulation.end_step();
    EXPECT_FALSE(changed().all_since(seen));
    const std::size_t bricks = newer(changed(), seen).size();
    if (implementation.name == "reference")
      EXPECT_EQ(bricks, brick_grid(kCells).cells()) << "it does not know";
    else
      EXPECT_TRUE(bricks > 0 && bricks < brick_grid(kCells).cells()) << bricks;
    seen = changed().now();
    worlds::put(simulation.mutable_volume(), 9, 9, 1, 0);
    EXPECT_TRUE(changed().all_since(seen)) << "by hand";
    simulation.step();
    EXPECT_TRUE(changed().all_since(seen));
    EXPECT_FALSE(changed().all_since(changed().now())) << "followed again";
  }
}

// Notes what the record says when light is asked for.
class Onlooker final : public visibility::Provider {
 public:
  explicit Onlooker(bool& knows) : knows_(knows) {}
  std::int64_t irradiance(const Volume& volume, const rule::Heat& /*heat*/, std::uint32_t /*step*/,
                          Field<std::uint16_t>& /*result*/) override {
    knows_ = !volume.changed.all_since(seen_);
    seen_ = volume.changed.now();
    return 0;
  }

 private:
  bool& knows_;
  ChangedBricks::Seen seen_;
};

// Pieces may fall before light is asked for. Where none does, the record is as good as before, whether
// somebody has looked at the volume since the last step or not.
TEST(ChangedBricks, KnowWhatChangedWhereNothingFalls) {
  for (const bool looks : {false, true}) {
    Volume start(kCells);
    worlds::fill_inert(start, {0, 0, 0, kCells.x, 1, kCells.z});
    worlds::fill(start, {70, 3, 1, 73, 5, 3}, 4096);
    rule::Parameters parameters = worlds::paper_showcase();
    parameters.heat.enabled = parameters.heat.radiation = true;
    parameters.heat.sources.push_back({{{0, {16, 160, 16}, 1}}});
    parameters.heat.visibility_every = 1;
    parameters.pieces.fall = true;
    bool knows = false;
    run::Simulation simulation(parameters, start, run::implementations().all()[1], {},
                               std::make_unique<Onlooker>(knows));
    for (int step = 0; step < 4; ++step) {
      simulation.step();
      EXPECT_EQ(knows, step > 0) << "step " << step << (looks ? ", looked at" : "");
      if (!looks) continue;
      const ChangedBricks& changed = simulation.volume().changed;
      EXPECT_FALSE(changed.all_since(changed.now()));
    }
  }
}

}  // namespace
}  // namespace voxmelt::state
