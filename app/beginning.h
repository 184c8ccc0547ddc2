// Where a command begins: a scene's first step, --from STEP, or --from CHECKPOINT.
#pragma once

#include <cstdint>
#include <string>

#include "app/options.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

struct Beginning {
  scene::Scene scene;
  std::uint32_t steps = 0;  // that are done when the command's own work begins
};

// `from` is a number of steps, or a checkpoint of the same scene. Throws UsageError.
Beginning begin_from(const Common& common, const std::string& from);

// The number that `from` is; throws UsageError where it is none.
std::uint32_t steps_of(const std::string& from);
bool names_a_file(const std::string& from);

// Refuses --steps STEPS of a scene that is a checkpoint beyond them; 0 asks for none.
void check_steps(const scene::Scene& scene, std::uint32_t steps);

}  // namespace voxmelt::app
