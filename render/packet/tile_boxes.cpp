#include "render/packet/tile_boxes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "render/packet/visible_area.h"

namespace voxmelt::render {
namespace {

constexpr std::int32_t kFar = INT32_MAX;
constexpr BlockBox kNothing{{kFar, kFar, kFar}, {0, 0, 0}};

void take_in(BlockBox& box, const BlockBox& other) {
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(box.low[axis], other.low[axis]);
    box.high[axis] = std::max(box.high[axis], other.high[axis]);
  }
}

}  // namespace

// Finds the boxes. Blocks surrounded by the shell lie between two parts of it, along any ray from outside. A
// box that holds both parts holds what is between. The eye must not be among them.
TileBoxes::TileBoxes(const PictureData& data, const Projection& projection, int side)
    : across_((data.width + side - 1) / side), down_((data.height + side - 1) / side) {
  const bool apart = data.view.near > 0;
  const auto tiles = static_cast<std::size_t>(across_) * down_;
  boxes_.assign(tiles, apart ? kNothing : BlockBox{{0, 0, 0}, {kFar, kFar, kFar}});
  if (!apart) return;
  const double places = static_cast<double>(side * picture::kPixel);
  for (std::size_t i = 0; i < data.field.shell_count; ++i) {
    const BlockBox& box = data.field.shell[i];
    const VisibleArea area = projection.of(low_of_block(box.low[0], box.low[1], box.low[2]),
                                           low_of_block(box.high[0], box.high[1], box.high[2]));
    // A place between two tiles counts for both.
    const auto first = [&](double at, int count) {
      return static_cast<int>(std::clamp(at / places - 1, 0.0, static_cast<double>(count)));
    };
    const auto end = [&](double at, int count) {
      return static_cast<int>(std::clamp(at / places + 1, 0.0, static_cast<double>(count)));
    };
    const int x1 = end(area.right, across_), y1 = end(area.bottom, down_);
    for (int y = first(area.top, down_); y < y1; ++y)
      for (int x = first(area.left, across_); x < x1; ++x) take_in(boxes_[y * across_ + x], box);
  }
}

bool TileBoxes::narrow(int tile, FieldData& field) const {
  const BlockBox& box = boxes_[tile];
  if (box.low[0] >= box.high[0]) {
    field.high = field.low = {};
    return false;
  }
  const picture::Vector low = low_of_block(box.low[0], box.low[1], box.low[2]),
                        high = low_of_block(box.high[0], box.high[1], box.high[2]);
  field.low = {std::max(field.low.x, low.x), std::max(field.low.y, low.y), std::max(field.low.z, low.z)};
  field.high = {std::min(field.high.x, high.x), std::min(field.high.y, high.y),
                std::min(field.high.z, high.z)};
  return field.low.x < field.high.x && field.low.y < field.high.y && field.low.z < field.high.z;
}

}  // namespace voxmelt::render
