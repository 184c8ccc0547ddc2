// Files of devices and families come with the program, or are the user's. Options change their numbers.
#pragma once

#include <string>
#include <vector>

#include "hwmodel/explore/device.h"
#include "hwmodel/explore/read_number.h"
#include "kernel/scene/text/document.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::hwmodel::explore {

scene::Value read_file(const std::vector<NamedText>& files, const std::string& folder,
                       const std::string& name, const std::string& place, const std::string& what);

// Changes the document, and tells which numbers were given.
Given override_file(scene::Value& document, const std::vector<std::string>& overrides);

scene::Reader table_of(scene::Reader& from, const std::string& key);  // it must be there

}  // namespace voxmelt::hwmodel::explore
