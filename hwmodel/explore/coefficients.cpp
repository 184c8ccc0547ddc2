#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "hwmodel/explore/ranges.h"

namespace voxmelt::hwmodel::explore {
namespace {

// Visits each number that may have a range, and tells if more of it is better.
template <class AnyDevice, class Visit>
void each_number(AnyDevice& device, const Visit& visit) {
  visit("device.clock", device.clock_mhz, true);
  visit("device.fill", device.fill, true);
  const auto logic = [&](const std::string& name, auto& cost) {
    visit("family." + name + ".lut", cost.lut, false);
    visit("family." + name + ".ff", cost.ff, false);
  };
  auto& f = device.family;
  logic("base", f.base);
  logic("port", f.port);
  logic("channel", f.channel);
  logic("coder", f.coder);
  logic("control", f.control);
  logic("divider", f.divider);
  logic("random_block", f.random_block);
  for (auto& [kind, cost] : f.stages) logic("stage." + std::string(name_of(kind)), cost.lane);
}

}  // namespace

std::vector<Coefficient> coefficients_of(const Device& device) {
  std::vector<Coefficient> found;
  each_number(device, [&](const std::string& name, const auto& number, bool more_is_better) {
    if (number.low == number.high) return;
    const auto low = static_cast<double>(number.low), high = static_cast<double>(number.high);
    found.push_back({name, number.source, static_cast<double>(number.value), more_is_better ? high : low,
                     more_is_better ? low : high});
  });
  return found;
}

Device with_value(Device device, const std::string& name, double value) {
  each_number(device, [&](const std::string& one, auto& number, bool) {
    using Value = std::remove_reference_t<decltype(number.value)>;
    if (one != name) return;
    if constexpr (std::is_integral_v<Value>)
      number.value = static_cast<Value>(std::llround(value));
    else
      number.value = value;
  });
  return device;
}

}  // namespace voxmelt::hwmodel::explore
