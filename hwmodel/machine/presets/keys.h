// Reads the keys of a machine's table.
#pragma once

#include <bit>
#include <cstdint>
#include <string>

#include "hwmodel/fabric/key.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::hwmodel {

// What `hw` does not say stays as it is. Throws scene::InputError with its place.
template <class Keys, class Configuration>
void read_keys(scene::Reader& hw, const Keys& keys, Configuration& configuration) {
  for (const Key<Configuration>& key : keys) {
    const std::string name(key.name);
    const std::int64_t value = hw.integer(name, key.low, key.high, key.get(configuration));
    if (key.power_of_two && !std::has_single_bit(static_cast<std::uint64_t>(value)))
      hw.fail(name, " = " + std::to_string(value) + " is not a power of 2: " + std::string(key.values));
    key.set(configuration, value);
  }
}

}  // namespace voxmelt::hwmodel
