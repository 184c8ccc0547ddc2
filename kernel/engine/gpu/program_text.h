// The source of all kernels, for a compiler of OpenCL C (program/). It is embedded at build.
#pragma once

#include <string>

namespace voxmelt::gpu {

std::string program_text();

}  // namespace voxmelt::gpu
