// Runs circuits beside their models and the software, in hostile worlds and in scenes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hwmodel/check/channel_trace.h"
#include "hwmodel/pipeline/model/pipeline.h"
#include "hwmodel/rtl/host/rtl_stage.h"
#include "tests/hwmodel/pipeline/check/lockstep_world.h"

namespace voxmelt::hwmodel {

// Counts what worlds had, so that a test knows that it looked at something.
struct Seen {
  int worlds = 0, refused = 0;
  int overlaps = 0;                           // trains of several passes
  int materials = 0;                          // worlds with several
  int holds = 0;                              // worlds in which a serial divider held a stage
  std::map<std::string, std::int64_t> cells;  // by stage that stood in
};

// Runs a machine with these stages in lock-step with the software, and notes what its channels do.
inline VerifyReport run(const Start& start, const Configuration& c, std::uint32_t steps,
                        const StageMaker& make, ChannelTrace& trace) {
  VerifyOptions options;
  options.steps = steps;
  options.configuration = c;
  options.machine = [&] {
    auto pipeline = std::make_unique<Pipeline>(start.parameters, start.volume.grid, c, make);
    pipeline->probe(&trace);
    return pipeline;
  };
  return verify(start.parameters, start.volume, start.step, run::implementations().widest(), {}, options);
}

inline void agree(const Start& start, Configuration c, std::uint32_t steps,
                  const std::vector<std::string>& only, int seed, Seen& seen) {
  c.registers = true;
  const Design design = design_of(start.parameters, start.volume.grid, c);
  if (const std::string refusal = rtl_refusal(design, only); !refusal.empty()) {
    ++seen.refused;
    return;
  }
  ChannelTrace circuits, models;
  const VerifyReport report = run(start, c, steps, rtl_stages(only, seed), circuits);
  ASSERT_EQ(report.mismatch, nullptr) << start.name << ", " << name_of(c) << ", grid " << start.volume.grid.x
                                      << " x " << start.volume.grid.y << " x " << start.volume.grid.z << ":\n"
                                      << text_of(*report.mismatch);
  // Both sides of every channel do the same in every cycle, whatever stalls.
  const VerifyReport wanted = run(start, c, steps, make_stage, models);
  ASSERT_EQ(wanted.mismatch, nullptr) << text_of(*wanted.mismatch);
  const auto difference = circuits.difference(models);
  ASSERT_FALSE(difference) << start.name << ", " << name_of(c) << ": cycle " << difference->cycle
                           << ", channel " << difference->channel;
  ASSERT_GT(circuits.cycles(), 0);
  for (const TrainReport& train : report.trains) seen.overlaps += train.passes > 1;
  seen.holds += wanted.cycles != wanted.predicted_cycles && c.stall_seed == 0;
  ++seen.worlds;
  seen.materials += start.parameters.has_materials();
  const auto cells = static_cast<std::int64_t>(start.volume.grid.cells());
  for (const StageKind kind : stages_of_step(design))
    if (rtl_has(kind) && (only.empty() || std::find(only.begin(), only.end(), name_of(kind)) != only.end()))
      seen.cells[std::string(name_of(kind))] += cells * steps;
}

inline Start world(std::uint64_t seed, int lanes, rule::Law law = rule::Law::paper) {
  worlds::Random random(seed * 31 + 5);
  state::Grid grid{random.between(1, 5 * lanes), random.between(12, 26),
                   random.one_in(2) ? random.between(8, 14) : random.between(1, 5)};
  if (seed % 3 == 0) grid.x = (grid.x + lanes - 1) / lanes * lanes;  // the last block is full
  Start start = hostile_start(seed, law, grid);
  start.parameters.flow.paper.use_table &= random.one_in(4);
  if (random.between(0, 3) != 0) start.parameters.flow.paper.reading = rule::EnergyReading::text;
  return start;
}

}  // namespace voxmelt::hwmodel
