#include "kernel/engine/gpu/devices.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

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

OpenClDevice limited(OpenClDevice device) {
  if (const auto most = limit("VOXMELT_DEVICE_MEMORY"))
    device.memory = std::min(device.memory, static_cast<std::uint64_t>(*most) << 20);
  return device;
}

}  // namespace

void add_implementations(step::Registry& registry) {
  const std::vector<OpenClDevice>& devices = open_cl_devices();
  for (std::size_t number = 0; number < devices.size(); ++number) {
    const OpenClDevice& device = devices[number];
    registry.add({"gpu:" + std::to_string(number),
                  device.name + (device.is_processor ? " (a processor), " : ", ") +
                      std::to_string(device.memory >> 20) + " MiB, " + device.driver,
                  [&device](const rule::Parameters& parameters, state::Grid grid,
                            const step::Tuning& /*threads and tiles are the device's*/)
                      -> std::unique_ptr<step::Stepper> {
                    const Constants constants = constants_of(parameters, Shape(grid));
                    return std::make_unique<Stepper>(
                        open(limited(device), &constants, limit("VOXMELT_DEVICE_PATIENCE").value_or(120)),
                        parameters, grid);
                  },
                  true, true, device.is_card});
  }
}

}  // namespace voxmelt::gpu
