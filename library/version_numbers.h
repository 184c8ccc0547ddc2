// Versions of a state as single numbers, and the bricks that have changed since one.
#pragma once

#include <cstdint>

#include "kernel/automaton/state/volume.h"
#include "voxmelt/changes.h"

namespace voxmelt::library {

// A volume that follows another one (after a restart) counts its versions from the beginning. Here they go on
// behind those of the volume before.
class VersionNumbers {
 public:
  Changes changes(const state::Volume& volume, std::uint64_t since);

 private:
  std::uint64_t volume_ = 0;  // state::ChangedBricks::Seen::volume of the last call
  std::uint64_t base_ = 0;    // what is added to its versions
  std::uint64_t newest_ = 0;  // that was given
};

}  // namespace voxmelt::library
