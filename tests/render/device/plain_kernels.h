// The picture's kernels (render/device/program) as C++20, for a plain device.
#pragma once

#include <span>

#include "tests/kernel/engine/gpu/plain_call.h"

namespace voxmelt::render {

std::span<const gpu::Call> plain_picture_kernels();

}  // namespace voxmelt::render
