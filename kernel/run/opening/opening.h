// From a scene to its run, and which implementation does it.
#pragma once

#include <memory>
#include <string>

#include "kernel/automaton/step/stepper.h"
#include "kernel/engine/visibility/visibility.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

namespace voxmelt::run {

// "auto" is the fastest one of this processor. Null for a name that no implementation has.
const step::Implementation* implementation_named(const std::string& name);
// "auto", and then the names of all, for messages.
std::string implementation_names();

// The run of a scene from its first step, or from where its checkpoint was written. Moves the scene's cells
// away, because a large state need not be held twice.
Simulation begin_run(scene::Scene& scene, const step::Implementation& implementation,
                     const step::Tuning& tuning,
                     std::unique_ptr<visibility::Provider> provider = nullptr);  // null: two levels

}  // namespace voxmelt::run
