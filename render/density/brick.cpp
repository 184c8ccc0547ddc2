#include "render/density/brick.h"

#include <cstddef>

namespace voxmelt::render {

BrickFlags widened(const state::Grid& bricks, BrickFlags flags) {
  // It goes axis by axis, over lines of `count` bricks, `stride` apart.
  const auto widen = [&](std::size_t stride, int count) {
    const std::size_t line = stride * static_cast<std::size_t>(count);
    for (std::size_t first = 0; first < flags.size(); first += line)
      for (std::size_t at = first; at < first + stride; ++at) {
        std::uint8_t before = 0;
        for (int i = 0; i < count; ++i) {
          std::uint8_t& flag = flags[at + static_cast<std::size_t>(i) * stride];
          const std::uint8_t here = flag, after = i + 1 < count ? *(&flag + stride) : std::uint8_t{0};
          flag = static_cast<std::uint8_t>(before | here | after);
          before = here;
        }
      }
  };
  const auto x = static_cast<std::size_t>(bricks.x), y = static_cast<std::size_t>(bricks.y);
  widen(1, bricks.x);
  widen(x, bricks.y);
  widen(x * y, bricks.z);
  return flags;
}

}  // namespace voxmelt::render
