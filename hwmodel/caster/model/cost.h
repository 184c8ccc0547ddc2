// What a pipe of the ray caster is made of: the wires of its channels, its memories, its multipliers and
// dividers. Widths and sizes come from the model; the units are counted from the expressions of a stage.
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
// One for each different product of a token, any width alike; none for shifts and for products with a
// constant that a stage has wired.
struct UnitCost {
  std::string stage;
  int multipliers = 0, dividers = 0;
};

struct PipeCost {
  std::vector<ChannelCost> channels;  // in the order of Pipe::channels
  std::vector<MemoryCost> memories;
  std::vector<UnitCost> units;  // of every stage, those without units too

  std::int64_t channel_bits() const;
  std::int64_t memory_bits() const;
  UnitCost all_units() const;
};
PipeCost cost_of(const Configuration& configuration, const Registers& registers, const Memory& memory);

}  // namespace voxmelt::hwmodel::raycast
