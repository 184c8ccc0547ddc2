// Text for docs is wrapped to lines of at most 96 columns.
#pragma once

#include <string>

namespace voxmelt::accuracy {

std::string wrapped(const std::string& text);

}  // namespace voxmelt::accuracy
