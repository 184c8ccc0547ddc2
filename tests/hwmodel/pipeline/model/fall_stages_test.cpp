// Gravity under the viscous law is tested alone. A stage of the test sets the side bands that settle and
// spread would bring, by its own few lines of docs/automaton.md, section 10. The result is compared with the
// reference.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "tests/hwmodel/pipeline/faults/strike_run.h"
#include "tests/rounds.h"

namespace voxmelt::hwmodel {
namespace {

using Marks = std::vector<std::uint8_t>;  // by the index of a cell

std::size_t index_of(state::Grid g, int x, int y, int z) {
  return (static_cast<std::size_t>(z) * static_cast<std::size_t>(g.y) + static_cast<std::size_t>(y)) *
             static_cast<std::size_t>(g.x) +
         static_cast<std::size_t>(x);
}

// Marks, in the volume before the excess phase, the cells of runs that will hold something after it.
Marks cells_in_runs(const state::Volume& v) {
  Marks marks(static_cast<std::size_t>(v.grid.cells()));
  for (int z = 0; z < v.grid.z; ++z)
    for (int x = 0; x < v.grid.x; ++x)
      for (int y = 0; y < v.grid.y; ++y) {
        const auto amount = [&](int at) { return std::int64_t{v.amount[v.at(x, at, z)]}; };
        if (is_blocked(v, x, y, z) || amount(y) == 0 || !is_blocked(v, x, y - 1, z)) continue;
        std::int64_t sum = amount(y);
        int top = y + 1;
        for (; !is_blocked(v, x, top, z); ++top) {
          if (sum <= (top - y) * kOne && (amount(top - 1) < kOne / 2 || amount(top) == 0)) break;
          sum += amount(top);
        }
        for (int at = y; at < top; ++at) marks[index_of(v.grid, x, at, z)] = sum > (at - y) * kOne;
        y = top - 1;
      }
  return marks;
}

class Marker final : public Stage {
 public:
  explicit Marker(const Design& design) : Stage(StageKind::viscous_spread, design, 0) {}
  const state::Volume* volume = nullptr;
  Marks in_run;
  state::BitPlane set;

 protected:
  void advance(const Cell* in, Cell* out) override {
    for (int lane = 0; lane < lanes(); ++lane) {
      out[lane] = in[lane];
      const int x = came().x + lane, y = came().y, z = came().z;
      if (x >= shape().grid.x) continue;
      out[lane].in_run = in_run[index_of(shape().grid, x, y, z)];
      out[lane].beside_wall = stands_beside_wall(*volume, x, y, z);
      out[lane].set = set.test(x, y, z);
    }
  }
};

// Runs until the fault strikes, and returns true if it did.
bool same_until_struck(std::uint64_t seed, state::Grid grid, int steps, Fault fault) {
  worlds::Random random(seed * 6007 + 11);
  const Design design{freezing_parameters(random, rule::Law::viscous, grid),
                      {grid, random.any({1, 2, 4, 8, 16})}};
  run::Simulation simulation(design.parameters, worlds::hostile_volume(random, design.parameters, grid),
                             worlds::implementation("reference"));
  Stages stages;
  stages.push_back(std::make_unique<Marker>(design));
  FaultPlan plan(fault, 0);
  const StageMaker make = fault == Fault::none ? StageMaker(make_stage) : planted_stages(plan);
  stages.push_back(make(StageKind::gravity, design));
  Marker& marker = static_cast<Marker&>(*stages.front());
  StageRun run{random.any({1, 2, 5}), random.one_in(2) ? 0 : seed + 1, 0};
  for (int step = 0; step < steps && !plan.struck(); ++step) {
    const auto number = simulation.steps_done();
    simulation.begin_step();
    for (const step::Phase phase : simulation.phases()) {
      const state::Volume before = simulation.volume();
      if (phase == step::Phase::melt) marker.set = set_places(design.parameters, before);
      if (phase == step::Phase::excess) marker.in_run = cells_in_runs(before);
      simulation.run_phase(phase);
      if (phase != step::Phase::gravity) continue;
      marker.volume = &before;
      const state::Volume result = run_stages(design, stages, step::Moment(number), nullptr, before, run);
      EXPECT_EQ(worlds::broken_invariant(result, design.parameters), "");
      EXPECT_EQ(first_difference(design.shape, simulation.volume(), result),
                plan.struck() ? name_of(*plan.struck()) : "")
          << "world " << seed << ", step " << step;
    }
    simulation.end_step();
  }
  return plan.struck().has_value();
}

TEST(FallStages, ViscousFallIsTheReferences) {
  for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(rounds(400)) && !testing::Test::HasFailure();
       ++seed) {
    worlds::Random random(seed);
    same_until_struck(seed, {random.between(1, 18), random.between(1, 14), random.between(1, 6)}, 3,
                      Fault::none);
  }
}

TEST(FallStages, EverySizeOfGrid) {
  for (const int size : {1, 2, 63, 64, 65})
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      same_until_struck(seed, {size, 5, 2}, 3, Fault::none);
      same_until_struck(seed, {3, size, 2}, 3, Fault::none);
      same_until_struck(seed, {2, 5, size}, 3, Fault::none);
    }
}

TEST(FallStages, FaultsStrikeWhereTheySay) {
  for (const Fault fault : {Fault::gravity_one_more, Fault::gravity_wall_missed, Fault::gravity_room,
                            Fault::gravity_column_wrap, Fault::gravity_mix, Fault::gravity_set_falls}) {
    int struck = 0;
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(rounds(240)); ++seed) {
      worlds::Random random(seed);
      struck += same_until_struck(seed, {random.between(1, 18), random.between(1, 9), random.between(1, 6)},
                                  3, fault);
    }
    EXPECT_GE(struck, rounds(fault == Fault::gravity_set_falls ? 10 : 30))
        << "fault " << static_cast<int>(fault);
  }
}

}  // namespace
}  // namespace voxmelt::hwmodel
