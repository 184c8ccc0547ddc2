// After a difference: the same pixel, drawn alone.
#pragma once

#include <optional>
#include <string>

#include "hwmodel/caster/check/verify_picture.h"

namespace voxmelt::hwmodel::raycast {

struct PixelReplay {
  Window part;         // a pixel, or the tile of a difference that belongs to a tile
  bool fails = false;  // alone, too
  std::string text;
};

// Nothing if the picture is good, or if what is wrong belongs to no pixel.
std::optional<PixelReplay> replay_pixel(const PictureInput& input, const PictureOptions& options,
                                        const PictureReport& report);
std::string text_of(const PixelReplay& replay);

// What --pixel says for a part of a picture: "X,Y", or "X,Y,WxH".
std::string pixel_text(const Window& part);

}  // namespace voxmelt::hwmodel::raycast
