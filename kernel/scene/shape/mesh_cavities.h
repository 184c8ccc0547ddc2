// Shells that point inward and lie within others are cavities.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/scene/shape/mesh_shells.h"

namespace voxmelt::scene {

// Tells, for each shell with true in `inward`, if its six outermost vertices are all enclosed by the other
// shells. `shell` has the number of each triangle's shell.
std::vector<bool> within_others(const Surface& surface, const std::vector<std::uint32_t>& shell,
                                const std::vector<bool>& inward);

}  // namespace voxmelt::scene
