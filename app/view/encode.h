// Frames become the bytes of pictures: PNG is exact, JPEG is fast.
#pragma once

#include <string>

#include "render/image/image.h"
#include "voxmelt/picture.h"

namespace voxmelt::view {

render::Image image_of(const Frame& frame);
std::string png_of(const Frame& frame);
std::string jpeg_of(const Frame& frame);  // quality 90

}  // namespace voxmelt::view
