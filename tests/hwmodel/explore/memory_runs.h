// Runs of the pipeline on a DRAM, simulated without arithmetic and predicted by the closed form.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "hwmodel/explore/content.h"
#include "hwmodel/explore/dram_time.h"
#include "hwmodel/explore/schedule.h"
#include "hwmodel/explore/timing.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/pipeline/streams/memory_streams.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::hwmodel::explore {

// Names the contents of the memory and their format.
enum class Kind { lit, dark, coded, tiles };

// Makes a scene with heat and radiation. Only its shape matters.
inline TimedRun timed(int lanes, int cascade, std::int64_t steps) {
  TimedRun run;
  run.parameters.heat.enabled = run.parameters.heat.radiation = true;
  run.parameters.heat.visibility_every = 16;
  run.grid = {64, 24, 40};
  run.configuration.lanes = lanes;
  run.configuration.cascade = cascade;
  run.steps = steps;
  return run;
}

// Makes a ball of matter that is as thick as the grid is high.
inline state::Volume ball(state::Grid grid) {
  state::Volume volume(grid);
  worlds::for_each(worlds::whole(grid), [&](int x, int y, int z) {
    const int a = 2 * x - grid.x, b = 2 * y - grid.y, c = 2 * z - grid.z;
    if (a * a / 4 + b * b + c * c < 600) worlds::put_solid(volume, x, y, z);
  });
  return volume;
}

// Holds a run with all that it reads. It must not move, because the run refers to it.
class MemoryRun {
 public:
  MemoryRun(TimedRun timed_run, Kind kind)
      : run(std::move(timed_run)),
        design(design_of(run.parameters, run.grid, run.configuration)),
        volume_(ball(run.grid)),
        field_(lit_field(run.grid, kind, volume_)),
        stream_(field_, design.shape),
        content(content_of(design, &field_, &volume_)) {
    run.configuration.coded = kind == Kind::coded;
    run.irradiance = [this](std::uint32_t) { return &stream_; };
    if (kind != Kind::coded) return;
    stored_ = stored_tokens(design, volume_);
    run.stored = [this](std::uint32_t) { return &stored_; };
  }
  MemoryRun(const MemoryRun&) = delete;
  MemoryRun& operator=(const MemoryRun&) = delete;

  std::int64_t simulated(const memory::Parameters& sheet, int mhz) const {
    MemoryStreams streams(design, run.configuration.cascade, sheet, mhz);
    const Timing timing = timing_of(run, &streams);
    return timing.hangs ? -1 : timing.cycles;
  }
  std::vector<Train> trains() const { return trains_of(design, run.configuration, 0, run.steps, content); }

 private:
  static Irradiance lit_field(state::Grid grid, Kind kind, const state::Volume& volume) {
    Irradiance field(grid);
    worlds::for_each(worlds::whole(grid), [&](int x, int y, int z) {
      if (kind != Kind::dark && (kind == Kind::lit || volume.solid.test(x, y, z)))
        field[field.layout().at(x, y, z)] = 7;
    });
    return field;
  }

 public:
  TimedRun run;
  Design design;

 private:
  state::Volume volume_;
  Irradiance field_;
  IrradianceStream stream_;
  StoredTokens stored_;

 public:
  Content content;
};

}  // namespace voxmelt::hwmodel::explore
