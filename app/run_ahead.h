// The software runs alone to the step from which the hardware is looked at.
#pragma once

#include <cstdint>

#include "app/options.h"

namespace voxmelt::app {

// To step `from` of the scene; with radiation to the last step of visibility before, of a checkpoint to the
// next one. `steps` follow it.
run::Simulation run_ahead(scene::Scene& scene, const Common& common, std::uint32_t from, std::uint32_t steps);

}  // namespace voxmelt::app
