// These states are timed.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/engine/visibility/visibility.h"
#include "kernel/scene/scene.h"

namespace voxmelt::measure {

struct Workload {
  std::string name;  // coordinates: "scene:cello/step:1050", "dense:256/law:paper/heat:on"
  rule::Parameters parameters;
  state::Volume start;
  bool times_flow = true, times_heat = false;
  bool at_rest = false;  // nothing in it can move: no roof
  // Steps run before the timed ones, because a fresh stepper does not know yet what sleeps.
  int lead_steps = 2;
  int steps = 8;  // timed
  // The results must have the digest of this implementation.
  std::string judge = "reference";
};

// Returns the middle of the scene's melt: the first multiple of 50 after which less than half of its solid
// cells are left. A _viscous sister has its sister's. For lava it is half the time that its vent is open. 0
// means unknown.
std::uint32_t middle_of(const std::string& scene);

// Lists the scenes that `voxmelt bench` times when not asked otherwise.
std::vector<std::string> usual_scenes(bool quick);

// Returns the scene at `step`, reached with the fastest implementation. Steps are counted from 0 again.
// Sources, vents and drains keep their times, but the random bits are those of other steps.
Workload scene_at(const scene::Scene& scene, std::uint32_t step, int threads,
                  std::unique_ptr<visibility::Provider> provider = nullptr);

// Returns the same sources, vents and drains, `steps` later.
rule::Parameters later(rule::Parameters parameters, std::uint32_t steps);

// Makes an n-cubed volume in which every cell is liquid and holds between half a cell and one and a half, at
// random. Columns fall and are pushed up, cells give and take. It is timed in its second step, before it
// settles. In the fifth hardly a cell gives, and only the tests of cells would be timed.
Workload dense_paper(int n, bool heat);

// Makes a closed pool: every cell is liquid and full, with columns under different pressure, so that every
// cell flows.
Workload dense_viscous(int n, bool heat);

// Makes every cell solid, at a random temperature below its melting point.
Workload dense_heat(int n, int neighbours);

// Makes a pool that came to rest in a box, `depth` cells deep.
Workload asleep(state::Grid grid, int depth, rule::Law law);

std::int64_t active_cells(const Workload& workload, bool heat);  // liquid; for heat also solid

}  // namespace voxmelt::measure
