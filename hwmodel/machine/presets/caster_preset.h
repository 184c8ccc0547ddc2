// The keys of the ray caster, the clock and the memory are read from the table `hw`.
#pragma once

#include "hwmodel/caster/model/configuration.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::hwmodel {

// Reads the keys `clock_mhz`, `memory`, `memory_trace` and `command_trace` of [hw]. The memory is "fixed", or
// a name or file as in hwmodel/memory/sheet.h.
void read_memory(scene::Reader& hw, raycast::Configuration& configuration);
// Reads all of these, and the keys of the ray caster.
void read_caster(scene::Reader& hw, raycast::Configuration& c);

}  // namespace voxmelt::hwmodel
