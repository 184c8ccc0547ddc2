// The ground's texture: colour by slope and elevation, and fine relief.
#pragma once

#include "kernel/scene/look.h"
#include "render/raycast/ground.h"

namespace voxmelt::render {

struct RockSample {
  Vec color;
  Vec normal;
};

// A flat floor has the look's colour; a terrain gets darker steep faces, paler heights and rough detail.
RockSample rock(const Ground& ground, const GroundHit& where, const scene::Look& look);

}  // namespace voxmelt::render
