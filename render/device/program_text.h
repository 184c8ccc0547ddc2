// The source of the picture's kernels, for a compiler of OpenCL C (program/). It is embedded at build.
#pragma once

#include <string>

namespace voxmelt::render {

std::string program_text();

}  // namespace voxmelt::render
