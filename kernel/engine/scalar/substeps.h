// The next step of the viscous law has a number of sub-steps (docs/automaton.md, section 10).
#pragma once

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::scalar {

// Returns that number. If a scene asks for as many as the state needs, it is the most that one of its runs
// needs.
int count_substeps(const rule::Parameters& parameters, const state::Volume& volume);

}  // namespace voxmelt::scalar
