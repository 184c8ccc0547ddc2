// A page is told everything of the world that a hand may change, as it is now.
#pragma once

#include <string>

#include "voxmelt/voxmelt.h"

namespace voxmelt::view {

// Returns a line of JSON with the type "world". `scene` is its name.
std::string world_of(const Simulation& simulation, const std::string& scene);

}  // namespace voxmelt::view
