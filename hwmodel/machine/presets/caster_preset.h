// The keys of the ray caster, and of clock and memory, in a table `hw`.
#pragma once

#include "hwmodel/caster/model/configuration.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::hwmodel {

// The keys `clock_mhz` and `memory` ("fixed", or as in hwmodel/memory/sheet.h) of [hw].
void read_clock_and_memory(scene::Reader& hw, raycast::Configuration& configuration);
// These, and `memory_trace`.
void read_memory(scene::Reader& hw, raycast::Configuration& configuration);
// All of them.
void read_caster(scene::Reader& hw, raycast::Configuration& c);

}  // namespace voxmelt::hwmodel
