// voxmelt verify --machine: the pipeline and the ray caster on one memory, in lock-step with the software.
#pragma once

#include "app/options.h"
#include "app/verify_picture.h"
#include "hwmodel/machine/machine.h"
#include "hwmodel/machine/presets/presets.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

// Simulates, prints and writes what came of it. `steps`: how the pipeline is verified.
hwmodel::MachineReport verify_machine(const Common& common, const PictureChoice& choice,
                                      const scene::Scene& scene, const run::Simulation& ahead,
                                      const hwmodel::Preset& preset, const hwmodel::VerifyOptions& steps);

}  // namespace voxmelt::app
