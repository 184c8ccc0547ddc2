// From light to bytes: tone mapping and the sRGB transfer curve.
#pragma once

#include "render/image/image.h"
#include "render/image/vector.h"

namespace voxmelt::render {

// Leaves the lower 70 % of the range as it is and rolls everything brighter smoothly into the rest, so that
// highlights and glowing liquid keep their shape instead of clipping.
Vec tone_mapped(Vec linear);

Rgb srgb(Vec linear);

}  // namespace voxmelt::render
