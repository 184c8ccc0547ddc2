// Stands for webp_bytes.cpp in a build without libwebp.
#include <string>

#include "render/frames/webp_bytes.h"
#include "render/image/png.h"

namespace voxmelt::render {

bool webp_is_built_in() { return false; }

std::string webp_bytes(const Image&, const Rectangle&, bool) {
  throw ImageError(std::string("this build has no libwebp: ") + kWebpCommand);
}

}  // namespace voxmelt::render
