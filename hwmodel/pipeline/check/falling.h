// The host finds the cells that fall, beside the pipeline: a search through all solids of the state before
// the step (docs/automaton.md, section 15).
#pragma once

#include <cstdint>
#include <optional>

#include "kernel/automaton/state/bit_plane.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/automaton/step/stepper.h"

namespace voxmelt::hwmodel {

// Returns the cells that fall in this step, if the scene lets pieces fall and any does.
std::optional<state::BitPlane> cells_that_fall(const rule::Parameters& parameters, std::uint32_t step,
                                               const state::Volume& before);

}  // namespace voxmelt::hwmodel
