// The option `voxmelt verify --size-fifos` finds the depths of channels before the run that verifies them.
#pragma once

#include <cstdint>
#include <string>

#include "app/options.h"
#include "hwmodel/machine/presets/presets.h"

namespace voxmelt::app {

// Holds what is to be verified.
struct VerifiedStream {
  const rule::Parameters& parameters;
  const state::Volume& volume;
  std::uint32_t first_step;
  std::uint32_t steps;
};

// Throws UsageError if the configuration names a channel that the machine does not have.
void check_channels(const VerifiedStream& stream, const hwmodel::Preset& preset);

// Finds them, prints them, writes them to `file`, and puts them into the preset. Returns the cycles of the
// run.
std::int64_t size_channels(const VerifiedStream& stream, const Common& common, const std::string& file,
                           hwmodel::Preset& preset);

// Says if the verified run took as many.
bool check_sized(std::int64_t wanted, std::int64_t cycles);

}  // namespace voxmelt::app
