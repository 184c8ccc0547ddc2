// NVIDIA's compiler at run time makes machine code of a program for one scene and one card.
#pragma once

#include <string>

#include "kernel/engine/gpu/cuda_library.h"

namespace voxmelt::gpu {

// Returns machine code for an architecture (compute capability, major * 10 + minor), of a program without its
// dialect. `options` are those of OpenCL's compiler: " -D NAME=value". The compiler's words about each kernel
// go to `said`, unless that is null. It throws DeviceError, with the compiler's words.
std::string compiled_for_cuda(const NvrtcLibrary& compiler, const std::string& text,
                              const std::string& options, int architecture, std::string* said = nullptr);

}  // namespace voxmelt::gpu
