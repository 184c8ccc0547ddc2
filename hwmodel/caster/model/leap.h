// A leap leaves out samples of a ray. The walk leaps through air, and the search for the ground above it. A
// watcher sees each leap, of which no token tells.
#pragma once

#include <cstdint>

#include "hwmodel/caster/model/ray_id.h"

namespace voxmelt::hwmodel::raycast {

// Tells why samples are left out.
enum class Leap : std::uint8_t { to_box, out_of_block, through_air, over_blocks, over_slopes };

// Describes a leap by so many samples. It begins at sample k or, over ground, at part k of the search.
struct LeapTaken {
  RayId id;
  Leap why = Leap::to_box;
  std::int64_t k = 0, steps = 0;
};

class LeapWatcher {
 public:
  virtual ~LeapWatcher() = default;
  virtual void leapt(const LeapTaken& leap) = 0;
};

}  // namespace voxmelt::hwmodel::raycast
