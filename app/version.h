#pragma once

#include <string>

namespace voxmelt::app {

std::string version_text();  // version, compiler, instruction sets, optional parts found
std::string version_number();

}  // namespace voxmelt::app
