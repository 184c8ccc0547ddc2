// Runs stages of the pipeline over a volume, with real channels between them but without SystemC. Tests use
// it to compare single stages with the reference's phases.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/pipeline/model/stages.h"
#include "hwmodel/pipeline/model/volume_port.h"
#include "tests/hwmodel/pipeline/model/freezing.h"
#include "tests/hwmodel/pipeline/model/sides.h"
#include "tests/kernel/engine/parallel/equal.h"
#include "tests/rounds.h"

namespace voxmelt::hwmodel {

struct StageRun {
  int depth = 2;
  std::uint64_t stall_seed = 0;
  std::int64_t cycles = 0;                 // cycles of the last run
  const state::Volume* sides = nullptr;    // tokens come with the side band `beside_wall` of this volume
  const state::BitPlane* set = nullptr;    // and with these places set
  const state::BitPlane* falls = nullptr;  // cells that fall
};

// Runs one pass of `volume` through `stages` at `moment`.
inline state::Volume run_stages(const Design& design, const Stages& stages, step::Moment moment,
                                const step::Irradiance* irradiance, const state::Volume& volume,
                                StageRun& run) {
  const Shape& shape = design.shape;
  std::vector<std::unique_ptr<CellFifo>> channels;
  for (std::size_t i = 0; i <= stages.size(); ++i)
    channels.push_back(
        std::make_unique<CellFifo>("channel", static_cast<int>(i), shape.lanes, run.depth, run.stall_seed));
  HeatFifo feed("feed", 1000, shape.lanes, run.depth, run.stall_seed);
  FallFifo falls("feed of pieces", 2000, shape.lanes, run.depth, run.stall_seed);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    stages[i]->feed(feed);
    stages[i]->feed_falls(falls);
    stages[i]->connect(*channels[i], *channels[i + 1]);
    stages[i]->begin_pass(moment, false);
  }

  state::Volume result(volume.grid);
  if (!volume.material.empty()) result.material = decltype(result.material)(volume.grid);
  const bool fed = irradiance != nullptr && std::any_of(stages.begin(), stages.end(), [](const auto& stage) {
                     return stage->kind() == StageKind::exchange;
                   });
  const bool cools = design.freezes() && stages.front()->kind() == StageKind::melt;
  Place reading, feeding, telling, writing;
  run.cycles = 0;
  while (writing.ordinal < shape.tokens()) {
    if (reading.ordinal < shape.tokens() && channels.front()->ready()) {
      Cell* lanes = channels.front()->put();
      read_token(volume, shape, reading, lanes, run.set);
      if (cools) mark_touches(volume, shape, reading, lanes);
      if (run.sides != nullptr) mark_walls(*run.sides, shape, reading, lanes);
      reading.next(shape);
    }
    if (fed && feeding.ordinal < shape.tokens() && feed.ready()) {
      UInt<16>* lanes = feed.put();
      for (int lane = 0; lane < shape.lanes; ++lane)
        lanes[lane] = feeding.x + lane < shape.grid.x
                          ? (*irradiance)[volume.at(feeding.x + lane, feeding.y, feeding.z)]
                          : 0;
      feeding.next(shape);
    }
    if (run.falls != nullptr && telling.ordinal < shape.tokens() && falls.ready()) {
      UInt<1>* lanes = falls.put();
      for (int lane = 0; lane < shape.lanes; ++lane) {
        const int x = telling.x + lane;
        lanes[lane] = x < shape.grid.x && run.falls->test(x, telling.y, telling.z) ? 1 : 0;
      }
      telling.next(shape);
    }
    for (const auto& stage : stages) stage->cycle();
    if (channels.back()->valid()) {
      write_token(channels.back()->get(), shape, writing, result);
      writing.next(shape);
    }
    feed.commit();
    falls.commit();
    for (const auto& channel : channels) channel->commit();
    if (++run.cycles > 1000 + 100 * shape.tokens() * static_cast<std::int64_t>(stages.size() + 8)) {
      ADD_FAILURE() << "the stages hang";
      return result;
    }
  }
  for (const auto& stage : stages) {
    EXPECT_TRUE(stage->done()) << stage->name();
    EXPECT_EQ(stage->cycles().total() % run.cycles, 0) << stage->name() << ": its cycles do not sum";
  }
  return result;
}

// Compares the stages of `make`, which must do the phases first..last whole, with the reference. There are
// `worlds` random hostile worlds of one law, with `steps` steps each. The other phases are the reference's.
template <class Make>  // void(const Design&, const StageMaker&, Stages&)
void expect_phases(rule::Law law, step::Phase first, step::Phase last, Make&& make, int worlds, int steps,
                   std::uint64_t first_seed = 0) {
  std::int64_t compared = 0, changed = 0;
  for (int world = 0; world < rounds(worlds); ++world) {
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(world);
    worlds::Random random(seed * 104729 + 17);
    const state::Grid grid =
        random.one_in(3) ? state::Grid{random.any({1, 2, 3, 4, 5, 15, 16, 17, 33}), random.any({1, 2, 3, 9}),
                                       random.any({1, 2, 5})}
                         : state::Grid{random.between(1, 14), random.between(1, 14), random.between(1, 14)};
    Design design{freezing_parameters(random, law, grid), {grid, random.any({1, 2, 4, 8, 16})}};
    state::Volume start = volume_of_materials(random, design.parameters, grid);
    run::Simulation simulation(design.parameters, std::move(start), worlds::implementation("reference"));
    const std::unique_ptr<visibility::Provider> provider = std::make_unique<visibility::VoxelWalkProvider>(1);
    step::Irradiance irradiance(grid);
    const rule::Heat& heat = design.parameters.heat;
    const bool radiates = heat.radiates();
    Stages stages;
    make(design, make_stage, stages);
    StageRun run{random.any({1, 2, 5}), random.one_in(2) ? 0 : seed + 1, 0};
    for (int step = 0; step < steps; ++step) {
      const auto number = simulation.steps_done();
      if (heat.is_visibility_step(number))
        provider->irradiance(simulation.volume(), heat, number, irradiance);
      simulation.begin_step();
      state::Volume before = simulation.volume(), unmelted = before;
      if (first == step::Phase::gravity && design.walls_in_conduction()) run.sides = &unmelted;
      state::BitPlane set(grid);
      run.set = first > step::Phase::melt ? &set : nullptr;
      for (const step::Phase each : simulation.phases()) {
        const step::Moment moment = simulation.moment();
        if (each == step::Phase::melt) set = set_places(design.parameters, unmelted = simulation.volume());
        if (each == first) before = simulation.volume();
        simulation.run_phase(each);
        if (each != last || stages.empty()) continue;
        const state::Volume result =
            run_stages(design, stages, moment, radiates ? &irradiance : nullptr, before, run);
        const std::string found = worlds::difference(simulation.volume(), result);
        compared += static_cast<std::int64_t>(grid.cells());
        changed += simulation.volume() == before ? 0 : 1;
        if (found.empty()) continue;
        FAIL() << "world " << seed << ", grid " << grid.x << " x " << grid.y << " x " << grid.z << ", "
               << design.shape.lanes << " lanes, step " << step << ": " << found;
      }
      simulation.end_step();
    }
  }
  EXPECT_GT(compared, rounds(worlds) * 20);  // nothing compared proves nothing
  EXPECT_GT(changed, rounds(worlds) / 4);
}

template <class Make>
void expect_phase(rule::Law law, step::Phase phase, Make&& make, int worlds, int steps,
                  std::uint64_t first_seed = 0) {
  expect_phases(law, phase, phase, std::forward<Make>(make), worlds, steps, first_seed);
}

}  // namespace voxmelt::hwmodel
