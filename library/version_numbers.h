// Versions of a state are single numbers here. They tell which bricks have changed since one of them.
#pragma once

#include <cstdint>

#include "kernel/automaton/state/volume.h"
#include "voxmelt/changes.h"

namespace voxmelt::library {

// Gives versions that never repeat. A volume that follows another one, after a restart, counts its versions
// from the beginning. Here the versions continue after those of the volume before.
class VersionNumbers {
 public:
  Changes changes(const state::Volume& volume, std::uint64_t since);

 private:
  std::uint64_t volume_ = 0;  // state::ChangedBricks::Seen::volume of the last call
  std::uint64_t base_ = 0;    // added to the versions of that volume
  std::uint64_t newest_ = 0;  // newest version that was given out
};

}  // namespace voxmelt::library
