// The source of all kernels, for a compiler of OpenCL C (program/). It is embedded at build.
#pragma once

#include <string_view>

namespace voxmelt::gpu {

std::string_view program_text();

}  // namespace voxmelt::gpu
