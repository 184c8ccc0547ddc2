#include "render/reference/levels.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace voxmelt::render {
namespace {

// Filters `from` along one axis, whose neighbours are `stride` values apart. Ends repeat themselves.
Values<std::uint16_t> along(const Values<std::uint16_t>& from, int side, std::size_t stride) {
  Values<std::uint16_t> to(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto place = static_cast<int>(i / stride % side);
    const std::size_t before = place > 0 ? i - stride : i, after = place < side - 1 ? i + stride : i;
    to[i] = static_cast<std::uint16_t>(picture::prefiltered(from[before], from[i], from[after]));
  }
  return to;
}

}  // namespace

Levels::Levels(const DensityField& field) : grid_(field.grid()), levels_(grid_.cells()) {
  const std::size_t x = grid_.x, y = grid_.y;
  const Values<std::uint16_t> filtered =
      along(along(along(field.intensity(), grid_.x, 1), grid_.y, x), grid_.z, x * y);
  std::transform(filtered.begin(), filtered.end(), levels_.data(), [](std::uint16_t intensity) {
    return static_cast<std::int16_t>(intensity - picture::kHalfIntensity);
  });
}

}  // namespace voxmelt::render
