// A time step has these stages, in the order of the stream. A scene gets only those that it uses.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

using Stages = std::vector<std::unique_ptr<Stage>>;
using StageMaker = std::function<std::unique_ptr<Stage>(StageKind, const Design&)>;

std::vector<StageKind> stages_of_step(const Design& design);

// Tells what one pass does with one tile. It runs whole time steps, or a part of one with more sub-steps than
// the machine has copies of settle and spread. Then the first pass has the stages before them, and the last
// one has gravity.
struct Pass {
  std::uint32_t first = 0;                   // number of the first time step
  int steps = 1;                             // 1..cascade
  int substep = 0, count = 1, substeps = 1;  // first sub-step, how many, and of how many
  int tile = 0;
  bool falls = false;  // does a piece fall at the begin of the first time step?

  bool begins() const { return substep == 0; }
  bool ends() const { return substep + count == substeps; }
  // Returns true if a stage works in this pass. `copy` is the number of this copy of settle or spread.
  bool uses(StageKind kind, int copy) const {
    if (kind == StageKind::settle || kind == StageKind::viscous_spread) return copy < count;
    if (kind == StageKind::fall) return begins() && falls;
    return kind == StageKind::gravity ? ends() : begins();
  }
};

// Makes a stage without faults. Throws std::logic_error for a kind that is no stage of a time step.
std::unique_ptr<Stage> make_stage(StageKind kind, const Design& design);

Stages make_step(const Design& design, const StageMaker& make = make_stage);

}  // namespace voxmelt::hwmodel
