// The cost of a pipe of the ray caster is the wires of its channels, its memories, its multipliers and
// dividers. Widths and sizes come from the model. The units are counted from the expressions of a stage.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hwmodel/caster/model/configuration.h"
#include "hwmodel/caster/model/layout.h"
#include "hwmodel/caster/model/registers.h"

namespace voxmelt::hwmodel::raycast {

struct ChannelCost {
  std::string name;
  int bits = 0, depth = 0;
  std::int64_t total() const { return std::int64_t{bits} * depth; }
};
struct MemoryCost {
  std::string stage, name;
  std::int64_t words = 0, bits = 0;
  std::int64_t total() const { return words * bits; }
};
// Counts one unit for each different product of a token, whatever its width. Shifts count none, and neither
// do products with a constant that a stage has wired.
struct UnitCost {
  std::string stage;
  int multipliers = 0, dividers = 0;
};

struct PipeCost {
  std::vector<ChannelCost> channels;  // in the order of Pipe::channels
  std::vector<MemoryCost> memories;
  std::vector<UnitCost> units;  // every stage, also those without units

  std::int64_t channel_bits() const;
  std::int64_t memory_bits() const;
  UnitCost all_units() const;
};
PipeCost cost_of(const Configuration& configuration, const Registers& registers, const Memory& memory);

}  // namespace voxmelt::hwmodel::raycast
