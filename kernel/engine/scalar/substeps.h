// The next step of the viscous law has a number of sub-steps, and of stages in which heads relax
// (docs/automaton.md, section 10).
#pragma once

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/automaton/step/phase.h"

namespace voxmelt::scalar {

// Returns these numbers. If a scene asks for as many sub-steps as the state needs, it is the most that one of
// its runs needs. The stages do what sub-steps leave.
step::Cadence count_substeps(const rule::Parameters& parameters, const state::Volume& volume);

}  // namespace voxmelt::scalar
