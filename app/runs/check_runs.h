// The runs of a plan are checked before the first one begins, so that a bad key is one message with its
// place.
#pragma once

#include <vector>

#include "app/runs/design.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

// Reads the scene that all runs share. Throws scene::InputError, or UsageError for a checkpoint.
scene::Scene scene_of(const Plan& plan);

// Throws scene::InputError, which names the place in the plan, for the first run that cannot begin.
void check_runs(const Plan& plan, const std::vector<PlannedRun>& runs, const scene::Scene& scene);

}  // namespace voxmelt::app
