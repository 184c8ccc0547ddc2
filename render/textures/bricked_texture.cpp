#include "render/textures/bricked_texture.h"

#include <algorithm>

namespace voxmelt::render {

std::size_t bytes_of(Texel texel) {
  switch (texel) {
    case Texel::u16:
      return 2;
    case Texel::u8x4:
    case Texel::i32:
      return 4;
    case Texel::u32x2:
    case Texel::i32x2:
      return 8;
    default:
      return 16;
  }
}

BrickedTexture::BrickedTexture(std::string_view name, Texel texel, Side size, Side brick)
    : name_(name), texel_(texel), brick_(brick), brick_bytes_(bytes_of(texel)) {
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bricks_[axis] = std::max(1, (size[axis] + brick[axis] - 1) / brick[axis]);
    brick_bytes_ *= static_cast<std::size_t>(brick[axis]);
    count *= static_cast<std::size_t>(bricks_[axis]);
  }
  bytes_.assign(count * brick_bytes_, 0);
  room_.assign(brick_bytes_, 0);
  versions_.assign(count, 0);
}

BrickedTexture::Side BrickedTexture::size() const {
  return {brick_[0] * bricks_[0], brick_[1] * bricks_[1], brick_[2] * bricks_[2]};
}

bool BrickedTexture::write_all(const void* table, Side size, std::uint64_t version) {
  const auto* const from = static_cast<const std::uint8_t*>(table);
  const std::size_t texel = bytes_of(texel_);
  bool changed = false;
  std::size_t brick = 0;
  for (int z = 0; z < size[2]; z += brick_[2])
    for (int y = 0; y < size[1]; y += brick_[1])
      for (int x = 0; x < size[0]; x += brick_[0], ++brick) {
        std::fill(room_.begin(), room_.end(), 0);
        const auto wide = static_cast<std::size_t>(std::min(brick_[0], size[0] - x)) * texel;
        for (int k = 0; k < std::min(brick_[2], size[2] - z); ++k)
          for (int j = 0; j < std::min(brick_[1], size[1] - y); ++j) {
            const std::size_t row = static_cast<std::size_t>(z + k) * size[1] + y + j;
            std::memcpy(room_.data() + static_cast<std::size_t>(k * brick_[1] + j) * brick_[0] * texel,
                        from + (row * size[0] + x) * texel, wide);
          }
        changed = write(brick, room_.data(), version) || changed;
      }
  return changed;
}

}  // namespace voxmelt::render
