// Which shells that point inward lie within others: these are cavities.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/scene/shape/mesh_shells.h"

namespace voxmelt::scene {

// For each shell with true in `inward`: whether its six outermost vertices are all inside what the other
// shells enclose. `shell` has the number of each triangle's shell.
std::vector<bool> within_others(const Surface& surface, const std::vector<std::uint32_t>& shell,
                                const std::vector<bool>& inward);

}  // namespace voxmelt::scene
