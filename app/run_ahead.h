// The software runs alone to the step from which the hardware is verified.
#pragma once

#include <cstdint>

#include "app/options.h"

namespace voxmelt::app {

// Runs to step `from` of the scene. With radiation it stops at the last step of visibility before. A
// checkpoint beyond that goes on to the next one. `steps` follow it.
run::Simulation run_ahead(scene::Scene& scene, const Common& common, std::uint32_t from, std::uint32_t steps);

}  // namespace voxmelt::app
