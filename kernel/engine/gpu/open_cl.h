// Devices of OpenCL 1.2 or later. The library is looked for when somebody asks for a device, so a program
// starts without it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kernel/engine/gpu/constants.h"
#include "kernel/engine/gpu/device.h"

namespace voxmelt::gpu {

struct OpenClDevice {
  std::string name;                             // as its driver calls it
  std::string driver;                           // its version, and that of OpenCL
  std::uint64_t memory = 0, largest_piece = 0;  // bytes
  bool is_processor = false;                    // an ordinary processor, no device of its own
  bool is_card = false;                         // a graphics card
  int units = 1;                                // that compute beside each other
  void* device = nullptr;                       // as the library knows it
};

// Returns all devices of all platforms, or none where there is no library or no driver.
const std::vector<OpenClDevice>& open_cl_devices();

// Builds the program for these numbers alone, or for any scene if `constants` is null. It throws DeviceError,
// with what the compiler of the driver says.
std::unique_ptr<Device> open(const OpenClDevice& device, const Constants* constants, Patience patience = {});

}  // namespace voxmelt::gpu
