// A family is read from its file.
#pragma once

#include <string>
#include <vector>

#include "hwmodel/explore/device.h"

namespace voxmelt::hwmodel::explore {

// Loads a family by name or path. `overrides` are such as "stage.melt.lut=70". If there is none of that name,
// the message begins with `place`.
Family load_family(const std::string& name, const std::string& place,
                   const std::vector<std::string>& overrides);

}  // namespace voxmelt::hwmodel::explore
