// The source of all kernels (program/), and what comes before it for each compiler. Both are embedded at
// build.
#pragma once

#include <string>

namespace voxmelt::gpu {

std::string program_text();
std::string open_cl_dialect();
std::string cuda_dialect();

}  // namespace voxmelt::gpu
