// Devices with the picture's kernels: the kernels as C++, and those of OpenCL.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "kernel/engine/gpu/open_cl.h"
#include "render/device/kernels.h"
#include "tests/kernel/engine/gpu/plain_device.h"
#include "tests/render/device/plain_kernels.h"

namespace voxmelt::render {

struct OnDevice {
  std::shared_ptr<gpu::Device> device;
  std::shared_ptr<const PictureKernels> kernels;
};
inline OnDevice plain(int threads) {
  const std::shared_ptr<gpu::Device> device = gpu::plain_device(threads, plain_picture_kernels());
  return {device, std::make_shared<PictureKernels>(device)};
}
// One program serves all scenes: its compiler takes seconds.
inline const OnDevice& open_cl() {
  static const std::shared_ptr<gpu::Device> device = gpu::open(gpu::open_cl_devices().front(), nullptr);
  static const OnDevice on{device, std::make_shared<PictureKernels>(device)};
  return on;
}

#define VOXMELT_NEEDS_A_DEVICE() \
  if (gpu::open_cl_devices().empty()) GTEST_SKIP() << "no device of OpenCL here (Debian: pocl-opencl-icd)"

}  // namespace voxmelt::render
