// The keys of the ray caster in a table `hw`.
#pragma once

#include "hwmodel/raycast/configuration.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::hwmodel {

void read_caster(scene::Reader& hw, raycast::Configuration& c);

}  // namespace voxmelt::hwmodel
