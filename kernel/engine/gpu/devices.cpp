#include "kernel/engine/gpu/devices.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "kernel/engine/gpu/cuda.h"
#include "kernel/engine/gpu/cuda_library.h"
#include "kernel/engine/gpu/open_cl.h"
#include "kernel/engine/gpu/stepper.h"

namespace voxmelt::gpu {

namespace {

// Returns a number from the environment, if it is one above 0.
std::optional<int> limit(const char* name) {
  const char* said = std::getenv(name);
  if (said == nullptr) return {};
  int value = 0;
  const std::string_view text = said;
  const auto [end, error] = std::from_chars(text.begin(), text.end(), value);
  if (error != std::errc() || end != text.end() || value < 1)
    throw step::DeviceError(std::string(name) + " is " + said + ", which is no whole number from 1 on");
  return value;
}

template <class Device>
Device limited(Device device) {
  if (const auto most = limit("VOXMELT_DEVICE_MEMORY"))
    device.memory = std::min(device.memory, static_cast<std::uint64_t>(*most) << 20);
  return device;
}

// `device` must outlive the registry.
template <class Device>
step::Implementation implementation(std::string name, std::string_view kind, bool is_card,
                                    const Device& device) {
  return {
      std::move(name),
      device.name + std::string(kind) + ", " + std::to_string(device.memory >> 20) + " MiB, " + device.driver,
      [&device](const rule::Parameters& parameters, state::Grid grid,
                const step::Tuning& tuning /*threads and tiles are the device's*/)
          -> std::unique_ptr<step::Stepper> {
        const Constants constants = constants_of(parameters, Shape(grid));
        const int patience = limit("VOXMELT_DEVICE_PATIENCE").value_or(120);
        return std::make_unique<Stepper>(open(limited(device), &constants, {patience, patience}), parameters,
                                         grid, tuning.sleep);
      },
      true,
      true,
      is_card};
}

}  // namespace

void add_implementations(step::Registry& registry) {
  int number = 0;
  for (const OpenClDevice& device : open_cl_devices())
    registry.add(implementation("gpu:" + std::to_string(number++),
                                device.is_processor ? " (a processor)" : "", device.is_card, device));
  number = 0;
  for (const CudaDevice& device : cuda_devices()) {
    registry.add(
        implementation(number == 0 ? "gpu:cuda" : "gpu:cuda:" + std::to_string(number), "", true, device));
    ++number;
  }
}

std::string missing_for_cuda() {
  if (cuda_library() == nullptr) return "this machine has no driver of CUDA (libcuda.so.1)";
  if (nvrtc_library() == nullptr)
    return "this machine has no compiler of CUDA (libnvrtc.so, of NVIDIA's toolkit)";
  return cuda_devices().empty() ? "the driver of CUDA has no device" : "";
}

}  // namespace voxmelt::gpu
