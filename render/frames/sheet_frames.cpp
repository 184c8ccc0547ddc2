#include "render/frames/sheet_frames.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "render/image/contact_sheet.h"

namespace voxmelt::render {
namespace {

constexpr std::size_t kMostShown = 12;

// Returns an image of half the size. Each pixel is the mean of four.
Image halved(const Image& image) {
  Image half(image.width / 2, image.height / 2);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const int sum = image.at(2 * x, 2 * y)[c] + image.at(2 * x + 1, 2 * y)[c] +
                        image.at(2 * x, 2 * y + 1)[c] + image.at(2 * x + 1, 2 * y + 1)[c];
        half.at(x, y)[c] = static_cast<std::uint8_t>((sum + 2) / 4);
      }
  return half;
}

}  // namespace

std::vector<std::size_t> shown_frames(std::size_t count) {
  const std::size_t shown = std::min(kMostShown, count);
  std::vector<std::size_t> frames;
  for (std::size_t k = 0; k < shown; ++k) frames.push_back(shown > 1 ? k * (count - 1) / (shown - 1) : 0);
  return frames;
}

SheetFrames::SheetFrames(std::size_t planned) {
  for (const std::size_t frame : shown_frames(planned)) halves_.emplace(frame, Image());
}

void SheetFrames::offer(std::size_t frame, const Image& image) {
  const auto place = halves_.find(frame);  // the map's keys do not change
  if (place == halves_.end()) return;
  Image half = halved(image);
  const std::lock_guard lock(mutex_);
  place->second = std::move(half);
}

Image SheetFrames::sheet(const std::vector<std::string>& labels,
                         const std::function<Image(std::size_t)>& read) const {
  std::vector<Image> frames;
  std::vector<std::string> shown_labels;
  for (const std::size_t frame : shown_frames(labels.size())) {
    const auto kept = halves_.find(frame);
    const bool here = kept != halves_.end() && kept->second.width > 0;  // otherwise an earlier part made it
    frames.push_back(here ? kept->second : halved(read(frame)));
    shown_labels.push_back(labels[frame]);
  }
  SheetStyle style;
  style.columns = frames.size() > 6 ? 4 : 3;
  return contact_sheet(frames, shown_labels, style);
}

}  // namespace voxmelt::render
