// The kernels of kernel/engine/gpu/program as C++20: the same source, so that sanitizers see it. A group has
// one item, and groups are divided among threads.
#pragma once

#include <memory>

#include "kernel/engine/gpu/device.h"

namespace voxmelt::gpu {

std::unique_ptr<Device> plain_device(int threads);

}  // namespace voxmelt::gpu
