#include "render/packet/plain_packet.h"

#include <cstddef>
#include <cstdint>

#include "render/packet/plain_scene.h"

namespace voxmelt::render {
namespace {

void draw(const PictureData& data, Places places, PressedLight to) {
  with_painter(data, [&](const auto& painter) {
    for (std::size_t i = 0; i < places.count; ++i) {
      const picture::Color light = painter.light(places.across[i], places.down[i]);
      to.red[i] = static_cast<std::uint16_t>(light[0]);
      to.green[i] = static_cast<std::uint16_t>(light[1]);
      to.blue[i] = static_cast<std::uint16_t>(light[2]);
    }
  });
}

void find(const PictureData& data, Places places, FoundSurface to) {
  with_painter(data, [&](const auto& painter) {
    for (std::size_t i = 0; i < places.count; ++i) {
      const Seen seen = painter.seen(places.across[i], places.down[i]);
      to.found[i] = seen.found ? -1 : 0;
      const std::int64_t numbers[6] = {seen.position.x, seen.position.y, seen.position.z,
                                       seen.normal.x,   seen.normal.y,   seen.normal.z};
      for (std::size_t j = 0; j < 6; ++j)
        (j < 3 ? to.position[j] : to.normal[j - 3])[i] = static_cast<std::int32_t>(numbers[j]);
    }
  });
}

}  // namespace

const Packets& plain_packets() {
  static constexpr Packets kPlain{&draw, &find, 1};
  return kPlain;
}

}  // namespace voxmelt::render
