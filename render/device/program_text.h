// The source of the kernels of pictures (program/). It is embedded at build.
#pragma once

#include <string>

namespace voxmelt::render {

std::string program_text();

}  // namespace voxmelt::render
