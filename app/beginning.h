// A command begins at a scene's first step, at --from STEP, or at --from CHECKPOINT.
#pragma once

#include <cstdint>
#include <string>

#include "app/options.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

struct Beginning {
  scene::Scene scene;
  std::uint32_t steps = 0;  // steps done when the command's own work begins
};

// Reads `from`, a number of steps or a checkpoint of the same scene. Throws UsageError.
Beginning begin_from(const Common& common, const std::string& from);

// Returns the number of steps in `from`. Throws UsageError if it is no number.
std::uint32_t steps_of(const std::string& from);
bool names_a_file(const std::string& from);

// Refuses --steps STEPS if the scene is a checkpoint beyond them, or if they need a step number beyond the
// last one. 0 means that no steps were given.
void check_steps(const scene::Scene& scene, std::uint32_t steps);

}  // namespace voxmelt::app
