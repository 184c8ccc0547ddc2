// Frames become the bytes of pictures: PNG is exact, JPEG is fast.
#pragma once

#include <string>

#include "voxmelt/picture.h"

namespace voxmelt::view {

std::string png_of(const Frame& frame);
std::string jpeg_of(const Frame& frame);  // quality 90

}  // namespace voxmelt::view
