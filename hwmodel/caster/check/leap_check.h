// A leap of a ray leaves out samples. Those that are left out must be air, and it must follow from what the
// walk knows: the box, the skip map and one level. A leap that is too long may well leave out nothing but
// air, so the pictures do not tell. The numbers here are exact quotients, from docs/picture/definition.md.
#pragma once

#include <cstdint>

#include "hwmodel/caster/model/registers.h"
#include "hwmodel/caster/model/walk_stage.h"

namespace voxmelt::hwmodel::raycast {

// Is a sample of a ray, in the lattice, and the way to the next one.
struct SampleOnRay {
  Vec at, step;
  std::int64_t level = 0;
};

// Returns how many samples a leap may go at most.
std::int64_t longest_leap(const SkipMap& skip, int spacing, Leap why, const SampleOnRay& sample);

}  // namespace voxmelt::hwmodel::raycast
