// The kernels of kernel/engine/gpu/program as C++20: the same source, so that sanitizers see it. A group has
// one item, and groups are divided among threads.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "kernel/engine/gpu/device.h"
#include "tests/kernel/engine/gpu/plain_call.h"

namespace voxmelt::gpu {

// `others` are the kernels of another program, in the order of its names.
std::unique_ptr<Device> plain_device(int threads, std::span<const Call> others = {});

// Returns a kernel of kernel/engine/gpu/program by its name, or null. It works on the group that `place`
// tells.
Take plain_kernel(std::string_view name);

}  // namespace voxmelt::gpu
