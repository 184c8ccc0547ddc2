// One picture of a WebP film is packed by libwebp, where the build found it.
#pragma once

#include <string>

#include "render/image/image.h"

namespace voxmelt::render {

inline constexpr int kWidestWebp = 16383;  // pixels of a side
// Brings what a build without libwebp lacks.
inline constexpr const char* kWebpCommand = "apt-get install libwebp-dev, then configure and build again";

struct Rectangle {
  int x = 0, y = 0, width = 0, height = 0;
};

// Tells whether this build has libwebp.
bool webp_is_built_in();

// Returns a part of the picture as a chunk of a WebP file. Throws ImageError.
std::string webp_bytes(const Image& image, const Rectangle& part, bool lossless);

}  // namespace voxmelt::render
