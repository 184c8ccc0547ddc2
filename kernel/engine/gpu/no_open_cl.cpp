// This build has no OpenCL.
#include <memory>
#include <vector>

#include "kernel/engine/gpu/open_cl.h"

namespace voxmelt::gpu {

const std::vector<OpenClDevice>& open_cl_devices() {
  static const std::vector<OpenClDevice> none;
  return none;
}

std::unique_ptr<Device> open(const OpenClDevice& /*device*/, const Constants* /*constants*/,
                             int /*patience*/) {
  throw DeviceError("this build has no OpenCL");
}

}  // namespace voxmelt::gpu
