// After a difference, the same pixel is drawn alone.
#pragma once

#include <optional>
#include <string>

#include "hwmodel/caster/check/verify_picture.h"

namespace voxmelt::hwmodel::raycast {

struct PixelReplay {
  Window part;         // a pixel, or the tile of a difference that belongs to a tile
  bool fails = false;  // also if drawn alone
  std::string text;
};

// Returns nothing if the picture is good, or if the failure belongs to no pixel.
std::optional<PixelReplay> replay_pixel(const PictureInput& input, const PictureOptions& options,
                                        const PictureReport& report);
std::string text_of(const PixelReplay& replay);

// Returns a part of a picture as --pixel takes it: "X,Y", or "X,Y,WxH".
std::string pixel_text(const Window& part);

}  // namespace voxmelt::hwmodel::raycast
