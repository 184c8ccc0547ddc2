// The keys of a machine's table are read by one loop over their descriptions.
#pragma once

#include <bit>
#include <cstdint>
#include <string>

#include "hwmodel/fabric/key.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::hwmodel {

// Keeps the value of every key that `hw` lacks. Throws scene::InputError with the place of a bad value.
template <class Keys, class Configuration>
void read_keys(scene::Reader& hw, const Keys& keys, Configuration& configuration) {
  for (const Key<Configuration>& key : keys) {
    const std::string name(key.name);
    const std::int64_t value = hw.integer(name, key.low, key.high, key.get(configuration));
    if (key.power_of_two && !std::has_single_bit<std::uint64_t>(value))
      hw.fail(name, " = " + std::to_string(value) + " is not a power of 2: " + std::string(key.values));
    key.set(configuration, value);
  }
}

}  // namespace voxmelt::hwmodel
