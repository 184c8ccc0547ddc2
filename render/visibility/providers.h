// The provider of irradiance casts its rays with Embree.
#pragma once

#include "kernel/engine/visibility/providers.h"

namespace voxmelt::visibility {

void add_embree(Providers& all);  // always a row, which says whether this build has Embree

}  // namespace voxmelt::visibility
