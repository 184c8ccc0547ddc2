// Settings of a scene can be checked without its volume.
#pragma once

#include <string>
#include <vector>

namespace voxmelt::scene {

// Checks `overrides`, as of --set, in settings that an earlier load() gave (Scene::settings). It throws
// InputError.
void check_overrides(const std::string& settings, const std::vector<std::string>& overrides);

}  // namespace voxmelt::scene
