// A Simulation gives away what its pictures are drawn from.
#include "voxmelt/textures.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "library/parts.h"
#include "library/translate.h"
#include "render/packet/scene_in_integers.h"
#include "render/textures/picture_textures.h"
#include "voxmelt/voxmelt.h"

namespace voxmelt {
namespace {

// Positions have 32 bits on a graphics processor, and a texture holds all places of the lattice.
constexpr int kMostSide = 1024;
constexpr std::size_t kMostCells = std::size_t{1} << 25;

Texture described(const render::BrickedTexture& texture) {
  return {texture.name(), static_cast<TexelFormat>(texture.texel()), texture.size(), texture.brick()};
}

void add_bricks(const render::BrickedTexture& texture, std::size_t number, std::uint64_t since,
                std::vector<TextureBrick>& to) {
  const std::array<int, 3>&bricks = texture.bricks(), &side = texture.brick();
  for (std::size_t brick = 0; brick < texture.count(); ++brick) {
    if (texture.version(brick) <= since) continue;
    const int i = static_cast<int>(brick);
    to.push_back(
        {number,
         {i % bricks[0] * side[0], i / bricks[0] % bricks[1] * side[1], i / bricks[0] / bricks[1] * side[2]},
         texture.bytes(brick)});
  }
}

}  // namespace

const render::PictureTextures& Simulation::Parts::textures() {
  const render::Picture& drawn = up_to_date();
  textures_.update(drawn.data(render::camera_in_integers(scene().camera), render::Setting::fast));
  return textures_;
}

Textures Simulation::textures(std::uint64_t version) {
  const Grid size = grid();
  if (std::max({size.x, size.y, size.z}) > kMostSide || size.cells() > kMostCells)
    throw InputError("textures: error: a grid of " + std::to_string(size.x) + " x " + std::to_string(size.y) +
                     " x " + std::to_string(size.z) + " cells exceeds 1024 along a side, or 2^25 in all");
  return library::translated([&] {
    const render::PictureTextures& kept = parts_->textures();
    Textures result;
    result.version = kept.version();
    result.everything = !kept.knows(version);
    for (const render::BrickedTexture& texture : kept.all()) {
      add_bricks(texture, result.textures.size(), result.everything ? 0 : version, result.bricks);
      result.textures.push_back(described(texture));
    }
    for (const render::PictureNumbers& number : kept.numbers())
      result.numbers.push_back({number.name, number.values});
    return result;
  });
}

}  // namespace voxmelt
