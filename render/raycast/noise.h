// Smooth value noise from an integer hash: the same everywhere, no tables.
#pragma once

#include "render/image/vector.h"

namespace voxmelt::render {

// -1..1, features about one unit wide.
float noise(Vec point);

// Sum of `octaves` noises, each twice as fine and half as strong as the one before; about -1..1.
float layered_noise(Vec point, int octaves);

}  // namespace voxmelt::render
