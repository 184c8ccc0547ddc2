// Many frames are put into one picture, in reading order.
#pragma once

#include <string>
#include <vector>

#include "render/image/image.h"

namespace voxmelt::render {

struct SheetStyle {
  int columns = 0;  // 0 for about as many as rows
  int gap = 6;      // pixels between and around the frames
  Rgb gap_color{255, 255, 255};
  Rgb label_color{70, 74, 84};
};

// Makes the sheet. `labels` may be empty or shorter than `frames`. Frames of another size than the first are
// cut or padded. Without frames the picture is empty.
Image contact_sheet(const std::vector<Image>& frames, const std::vector<std::string>& labels,
                    const SheetStyle& style = {});

}  // namespace voxmelt::render
