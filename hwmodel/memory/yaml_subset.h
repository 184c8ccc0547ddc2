// Configurations of Ramulator are YAML. This reader knows the part of it that they need: maps by indentation,
// lists of plain values, values without quotes or in quotes, and comments. It refuses everything else by its
// line.
#pragma once

#include <memory>
#include <string>

#include "kernel/scene/text/document.h"

namespace voxmelt::hwmodel {

// Returns the map as a table. A whole number is an integer, another number is real, `true` and `false` are
// boolean. A key without a value is an empty table. Throws scene::InputError.
scene::Value parse_yaml_subset(const std::string& text, const std::shared_ptr<const scene::Origin>& origin);

}  // namespace voxmelt::hwmodel
