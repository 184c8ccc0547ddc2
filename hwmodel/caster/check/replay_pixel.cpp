#include "hwmodel/caster/check/replay_pixel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace voxmelt::hwmodel::raycast {
namespace {

// Returns the pixels of a tile that the picture has.
Window whole_tile(std::int32_t x, std::int32_t y, const render::Image& image) {
  return {x, y, std::min(x + kTileSide, image.width), std::min(y + kTileSide, image.height)};
}

std::optional<Window> part_of(const PictureReport& report) {
  const auto box = [](std::int32_t x, std::int32_t y, std::int32_t side) {
    return Window{x, y, x + side, y + side};
  };
  if (report.difference) {
    const Difference& d = *report.difference;
    if (d.address >= 0) return {};
    const bool of_tile = d.stage == "dealer" || d.stage == "write";
    return of_tile ? whole_tile(d.x, d.y, report.image) : box(d.x, d.y, 1);
  }
  if (!report.hang.empty()) {
    if (!report.under_way) return {};
    return box(report.under_way->x, report.under_way->y, 1);
  }
  if (!report.different) return {};
  return box(report.different->x, report.different->y, 1);
}

}  // namespace

std::optional<PixelReplay> replay_pixel(const PictureInput& input, const PictureOptions& options,
                                        const PictureReport& report) {
  const std::optional<Window> part = report.good() ? std::nullopt : part_of(report);
  if (!part) return {};
  PictureOptions alone = options;
  alone.window = *part;
  alone.compare = true;  // to name the stage
  alone.frames = 1;
  alone.waves = false;
  const PictureReport again = verify_picture(input, alone);
  PixelReplay replay{*part, !again.good(), again.hang};
  if (again.difference) replay.text = text_of(*again.difference);
  return replay;
}

std::string text_of(const PixelReplay& replay) {
  const Window& part = replay.part;
  const std::string what = part.right == part.left + 1
                               ? fmt::format("pixel ({}, {})", part.left, part.top)
                               : fmt::format("the tile of pixel ({}, {})", part.left, part.top);
  if (!replay.fails)
    return fmt::format("{}, drawn alone, is right: what is drawn before or beside it matters\n", what);
  return fmt::format("{}, drawn alone, fails too:\n{}", what, replay.text);
}

std::string pixel_text(const hwmodel::raycast::Window& part) {
  const std::int32_t wide = part.right - part.left, high = part.bottom - part.top;
  const std::string place = fmt::format("{},{}", part.left, part.top);
  return wide == 1 && high == 1 ? place : fmt::format("{},{}x{}", place, wide, high);
}

}  // namespace voxmelt::hwmodel::raycast
