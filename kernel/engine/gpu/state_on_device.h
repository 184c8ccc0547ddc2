// Where a state lies in a device's memory, for kernels that read it there (program/cells.cl).
#pragma once

#include <cstdint>
#include <memory>

#include "kernel/engine/gpu/device.h"
#include "kernel/engine/gpu/shape.h"

namespace voxmelt::gpu {

struct StateOnDevice {
  std::shared_ptr<Device> device;
  const Shape* shape;
  const Memory *flags, *amount;
  const Memory* heat;     // null in a scene without heat
  std::uint64_t taken;    // bytes of the device's memory that the stepper has
  int groups;             // as many as the stepper runs
  std::uint64_t version;  // no other state of this process has it
};

}  // namespace voxmelt::gpu
