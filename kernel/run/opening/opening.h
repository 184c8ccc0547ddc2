// A scene is opened as a run, with a chosen implementation.
#pragma once

#include <memory>
#include <string>

#include "kernel/automaton/step/stepper.h"
#include "kernel/engine/visibility/visibility.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

namespace voxmelt::run {

// Returns the implementation of this name. "auto" is the fastest one of this processor. An unknown name gives
// null.
const step::Implementation* implementation_named(const std::string& name);
// Lists "auto", and then the names of all, for messages.
std::string implementation_names();

// Returns the run of a scene from its first step, or from the step of its checkpoint. It moves the scene's
// cells away, because a large state need not be held twice.
Simulation begin_run(scene::Scene& scene, const step::Implementation& implementation,
                     const step::Tuning& tuning,
                     std::unique_ptr<visibility::Provider> provider = nullptr);  // null: two levels

}  // namespace voxmelt::run
