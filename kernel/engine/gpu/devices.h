// The devices of this machine are implementations, too: gpu:0, gpu:1 and so on. Two variables of the
// environment limit them: VOXMELT_DEVICE_MEMORY, in MiB, and VOXMELT_DEVICE_PATIENCE, the seconds after which
// a device that does not answer is lost.
#pragma once

#include "kernel/automaton/step/stepper.h"

namespace voxmelt::gpu {

// Adds one for each device. It looks for drivers, which may take a moment.
void add_implementations(step::Registry& registry);

}  // namespace voxmelt::gpu
