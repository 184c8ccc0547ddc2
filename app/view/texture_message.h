// Textures become the bytes of a message.
//
// They are packed in zlib's format. Inside there is a length of four bytes, little-endian, a description in
// JSON that is as long, and then each brick: the number of its texture and its first texel, x, y and z, as
// four numbers of 16 bits, and its bytes.
#pragma once

#include <string>

#include "voxmelt/textures.h"

namespace voxmelt::view {

std::string packed(const Textures& textures);

}  // namespace voxmelt::view
