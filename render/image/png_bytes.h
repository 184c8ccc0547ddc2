// The bytes of a PNG file are made in a third of libpng's time or less, with at most a tenth more bytes.
#pragma once

#include <string>

#include "render/image/image.h"

namespace voxmelt::render {

std::string png_bytes(const Image& image);    // marked as sRGB
std::string png_bytes(const Image16& image);  // grey or RGB; unmarked, as these are no colours

}  // namespace voxmelt::render
