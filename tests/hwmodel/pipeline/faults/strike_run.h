// Plants a fault in the stages of one whole phase. The first cell of the stream that differs from the
// reference must be the one that the fault names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/pipeline/faults/planted_stages.h"
#include "tests/hwmodel/pipeline/model/stage_run.h"
#include "tests/rounds.h"

namespace voxmelt::hwmodel {

// Returns the first cell in the order of the stream that differs, or "".
inline std::string first_difference(const Shape& shape, const state::Volume& a, const state::Volume& b) {
  std::vector<Cell> left(static_cast<std::size_t>(shape.lanes)), right(left);
  for (Place place; place.ordinal < shape.tokens(); place.next(shape)) {
    read_token(a, shape, place, left.data());
    read_token(b, shape, place, right.data());
    for (int lane = 0; lane < shape.lanes; ++lane)
      if (left[static_cast<std::size_t>(lane)] != right[static_cast<std::size_t>(lane)])
        return std::to_string(place.x + lane) + ", " + std::to_string(place.y) + ", " +
               std::to_string(place.z);
  }
  return "";
}

inline std::string name_of(const FaultPlan::Strike& strike) {
  return std::to_string(strike.x) + ", " + std::to_string(strike.y) + ", " + std::to_string(strike.z);
}

// Runs every world until the fault strikes, for up to `steps` steps. At least `wanted` worlds must be struck.
template <class Make>  // void(const Design&, const StageMaker&, Stages&)
void expect_strikes(rule::Law law, step::Phase phase, Fault fault, Make&& make, int worlds, int steps,
                    int wanted) {
  int struck = 0;
  for (int world = 0; world < rounds(worlds); ++world) {
    worlds::Random random(static_cast<std::uint64_t>(world) * 7919 + 3);
    const state::Grid grid{random.between(1, 20), random.between(1, 8), random.between(1, 6)};
    Design design{freezing_parameters(random, law, grid), {grid, random.any({1, 2, 4, 8, 16})}};
    state::Volume start = volume_of_materials(random, design.parameters, grid);
    run::Simulation simulation(design.parameters, std::move(start), worlds::implementation("reference"));
    FaultPlan plan(fault, static_cast<std::uint32_t>(random.below(2)));
    Stages stages;
    make(design, planted_stages(plan), stages);
    if (stages.empty()) continue;
    StageRun run{2, 0, 0};
    for (int step = 0; step < steps && !plan.struck(); ++step) {
      const auto number = simulation.steps_done();
      simulation.begin_step();
      state::Volume unmelted = simulation.volume();
      if (phase == step::Phase::gravity && design.walls_in_conduction()) run.sides = &unmelted;
      state::BitPlane set(grid);
      run.set = &set;
      for (const step::Phase each : simulation.phases()) {
        const step::Moment moment = simulation.moment();
        const state::Volume before = simulation.volume();
        if (each == step::Phase::melt) set = set_places(design.parameters, unmelted = before);
        simulation.run_phase(each);
        if (each != phase || plan.struck()) continue;
        const state::Volume result = run_stages(design, stages, moment, nullptr, before, run);
        ASSERT_EQ(worlds::broken_invariant(result, design.parameters), "") << "world " << world;
        const std::string found = first_difference(design.shape, simulation.volume(), result);
        const std::string named = plan.struck() ? name_of(*plan.struck()) : "";
        ASSERT_EQ(found, named) << "world " << world << ", step " << step;
        if (plan.struck()) {
          ASSERT_EQ(plan.struck()->step, number);
        }
      }
      simulation.end_step();
    }
    struck += plan.struck() ? 1 : 0;
  }
  EXPECT_GE(struck, rounds(wanted));
  std::printf("             struck in %d of %d worlds\n", struck, rounds(worlds));
}

}  // namespace voxmelt::hwmodel
