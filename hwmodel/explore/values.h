// A key takes several values: "memory.channels=1..32", "device.clock=150,200,300",
// "device.fill=0.5..0.9+0.1".
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace voxmelt::hwmodel::explore {

inline constexpr std::size_t kMostValues = 64;

struct Values {
  std::string key;
  std::vector<std::string> values;
};

// Reads a list, or a range: it doubles from its first value, or grows by what follows a "+". The last value
// is in it if it is met. Throws std::invalid_argument with what is wrong.
Values values_of(const std::string& text);

}  // namespace voxmelt::hwmodel::explore
