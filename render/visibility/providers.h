// The provider of irradiance whose rays Embree follows.
#pragma once

#include "kernel/engine/visibility/providers.h"

namespace voxmelt::visibility {

void add_embree(Providers& all);  // a row in any case: it says whether this build has Embree

}  // namespace voxmelt::visibility
