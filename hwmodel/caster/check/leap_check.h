// A leap of a ray leaves out samples. Those that are left out must be air, and it must follow from what the
// walk knows: the box, the skip map and one level. A leap that is too long may well leave out nothing but
// air, so the pictures do not tell. The numbers here are exact quotients, from docs/picture/definition.md.
#pragma once

#include <cstdint>

#include "hwmodel/caster/model/leap.h"
#include "hwmodel/caster/model/registers.h"

namespace voxmelt::hwmodel::raycast {

// Is a sample of a ray, in the lattice, and the way to the next one.
struct SampleOnRay {
  Vec at, step;
  std::int64_t level = 0;
};

// Returns how many samples a leap of the walk may go at most.
std::int64_t longest_leap(const SkipMap& skip, int spacing, Leap why, const SampleOnRay& sample);

// Is a place of a ray in search of the ground, and the last sample that is not behind it.
struct PlaceOverGround {
  Vec at, sample, step;
  std::int64_t above = 0;  // the ground, in 2^-12 cells
};

// Returns how many samples a leap over ground may go at most, from that sample on.
std::int64_t longest_leap(const GroundBlocks& blocks, Leap why, const PlaceOverGround& place);

}  // namespace voxmelt::hwmodel::raycast
