// The bytes of a PNG file. Fast rather than smallest: a fifth of libpng's time, a sixth more bytes.
#pragma once

#include <string>

#include "render/image/image.h"

namespace voxmelt::render {

std::string png_bytes(const Image& image);    // marked as sRGB
std::string png_bytes(const Image16& image);  // grey or RGB, marked as nothing: no colours

}  // namespace voxmelt::render
