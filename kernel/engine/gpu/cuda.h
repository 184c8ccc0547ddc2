// Devices of CUDA: NVIDIA's cards, by their driver and by the compiler of its toolkit, both found at run
// time. The kernels are those of OpenCL, in another dialect (program/dialect_cuda.cl).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kernel/engine/gpu/constants.h"
#include "kernel/engine/gpu/cuda_library.h"
#include "kernel/engine/gpu/device.h"

namespace voxmelt::gpu {

struct CudaDevice {
  std::string name;          // as its driver calls it
  std::string driver;        // the versions of CUDA that the driver and the compiler have
  std::uint64_t memory = 0;  // bytes
  int units = 1;             // multiprocessors
  int architecture = 0;      // compute capability, major * 10 + minor
  int number = 0;            // as the driver counts
};

// The driver and the compiler. Tests have others.
struct Cuda {
  const CudaLibrary* driver = nullptr;
  const NvrtcLibrary* compiler = nullptr;
};

// Returns all devices, or none where the driver or the compiler is missing.
const std::vector<CudaDevice>& cuda_devices();
std::vector<CudaDevice> devices_of(const Cuda& cuda);

// As open() in open_cl.h. It throws DeviceError, with what the compiler says, and step::DeviceLost if the
// device does not answer. The compiler works in this program, and nobody gives it up.
std::unique_ptr<Device> open(const CudaDevice& device, const Constants* constants, Patience patience = {});
std::unique_ptr<Device> open(const Cuda& cuda, const CudaDevice& device, const Constants* constants,
                             Patience patience);

}  // namespace voxmelt::gpu
