// Bytes are packed into zlib's format, as PNG files and messages have it.
#pragma once

#include <string>
#include <string_view>

namespace voxmelt::render {

std::string zlib_bytes(std::string_view plain);

}  // namespace voxmelt::render
