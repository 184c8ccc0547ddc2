// The stages of one time step, in the order of the stream. A scene gets only those that it uses.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "hwmodel/stream/stage.h"

namespace voxmelt::hwmodel {

using Stages = std::vector<std::unique_ptr<Stage>>;
using StageMaker = std::function<std::unique_ptr<Stage>(StageKind, const Design&)>;

std::vector<StageKind> stages_of_step(const Design& design);

// Makes a stage without faults. Throws std::logic_error for a kind that is no stage of a time step.
std::unique_ptr<Stage> make_stage(StageKind kind, const Design& design);

Stages make_step(const Design& design, const StageMaker& make = make_stage);

}  // namespace voxmelt::hwmodel
