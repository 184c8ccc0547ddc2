#include "render/image/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/image/label.h"

namespace voxmelt::render {
namespace {

void paste(Image& sheet, const Image& frame, int x0, int y0, int width, int height) {
  for (int y = 0; y < std::min(height, frame.height); ++y)
    for (int x = 0; x < std::min(width, frame.width); ++x) sheet.at(x0 + x, y0 + y) = frame.at(x, y);
}

}  // namespace

Image contact_sheet(const std::vector<Image>& frames, const std::vector<std::string>& labels,
                    const SheetStyle& style) {
  if (frames.empty()) return {};
  const int count = static_cast<int>(frames.size());
  const int columns =
      std::min(count, style.columns > 0 ? style.columns : static_cast<int>(std::ceil(std::sqrt(count))));
  const int rows = (count + columns - 1) / columns;
  const int width = frames[0].width, height = frames[0].height;
  const int scale = std::max(1, width / 240);

  Image sheet(columns * (width + style.gap) + style.gap, rows * (height + style.gap) + style.gap,
              style.gap_color);
  for (int i = 0; i < count; ++i) {
    const int x0 = style.gap + (i % columns) * (width + style.gap);
    const int y0 = style.gap + (i / columns) * (height + style.gap);
    const std::size_t index = i;
    paste(sheet, frames[index], x0, y0, width, height);
    if (index < labels.size())
      draw_label(sheet, labels[index], x0 + 4 * scale, y0 + 4 * scale, scale, style.label_color);
  }
  return sheet;
}

}  // namespace voxmelt::render
