// The devices of this machine are implementations, too: gpu:0, gpu:1 and so on are those of OpenCL, and
// gpu:cuda, gpu:cuda:1 and so on those of CUDA. Two variables of the environment limit them:
// VOXMELT_DEVICE_MEMORY, in MiB, and VOXMELT_DEVICE_PATIENCE, the seconds after which a device that does not
// answer is lost.
#pragma once

#include <string>

#include "kernel/automaton/step/stepper.h"

namespace voxmelt::gpu {

// Adds one for each device. It looks for drivers, which may take a moment.
void add_implementations(step::Registry& registry);

// Returns what this machine lacks for CUDA, or nothing.
std::string missing_for_cuda();

}  // namespace voxmelt::gpu
