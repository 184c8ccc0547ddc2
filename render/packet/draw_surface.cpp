#include "render/packet/draw_surface.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "kernel/engine/cpu/workers.h"
#include "render/packet/draw_picture.h"
#include "render/packet/plain_packet.h"
#include "render/packet/plain_scene.h"

namespace voxmelt::render {
namespace {

// Calls found(pixel, position, normal) for each pixel whose middle shows something, on some threads.
template <class Found>
void for_surfaces(const PictureData& data, const Packets& wanted, int threads, const Found& found) {
  const Packets& packets = fits_lanes(data) ? wanted : plain_packets();
  constexpr int kRow = 64;  // pixels at a time
  const int across = (data.width + kRow - 1) / kRow;
  cpu::Workers(std::min(threads, cpu::Workers::most())).run(across * data.height, [&](int index) {
    const int x0 = index % across * kRow, y = index / across;
    std::array<std::int32_t, kRow + kMostLanes> places[2], mask, numbers[6];
    const std::size_t count = std::min(kRow, data.width - x0);
    for (std::size_t i = 0; i < kRow + kMostLanes; ++i) {
      const auto x = x0 + static_cast<std::int64_t>(std::min(i, count - 1));
      places[0][i] = static_cast<std::int32_t>(x * picture::kPixel + picture::kMiddle[0].across);
      places[1][i] = static_cast<std::int32_t>(y * picture::kPixel + picture::kMiddle[0].down);
    }
    packets.find(data, {places[0].data(), places[1].data(), count},
                 {mask.data(),
                  {numbers[0].data(), numbers[1].data(), numbers[2].data()},
                  {numbers[3].data(), numbers[4].data(), numbers[5].data()}});
    const std::size_t first = static_cast<std::size_t>(y) * data.width + x0;
    for (std::size_t i = 0; i < count; ++i)
      if (mask[i] != 0)
        found(first + i, picture::Vector{numbers[0][i], numbers[1][i], numbers[2][i]},
              std::array{numbers[3][i], numbers[4][i], numbers[5][i]});
  });
}

std::size_t pixels_of(const PictureData& data) { return static_cast<std::size_t>(data.width) * data.height; }

}  // namespace

SurfacePicture draw_surface(const PictureData& data, const Packets& packets, int threads) {
  SurfacePicture picture{data.width, data.height, {}, {}};
  picture.depth.assign(pixels_of(data), picture::kNoDepth);
  picture.normal.assign(pixels_of(data), {});
  for_surfaces(data, packets, threads,
               [&](std::size_t pixel, picture::Vector position, const std::array<std::int32_t, 3>& normal) {
                 picture.depth[pixel] =
                     static_cast<std::uint16_t>(picture::depth_in_picture(data.view, position));
                 for (std::size_t c = 0; c < 3; ++c)
                   picture.normal[pixel][c] = static_cast<std::int16_t>(normal[c]);
               });
  return picture;
}

std::vector<float> draw_depths(const PictureData& data, const Packets& packets, int threads) {
  std::vector<float> depths(pixels_of(data), std::numeric_limits<float>::infinity());
  for_surfaces(data, packets, threads,
               [&](std::size_t pixel, picture::Vector position, const auto& /*normal*/) {
                 depths[pixel] = static_cast<float>(picture::depth_from_eye(data.view, position)) /
                                 static_cast<float>(picture::kDepthUnit);
               });
  return depths;
}

std::optional<Sight> see_pixel(const PictureData& data, int x, int y) {
  const std::int64_t across = std::int64_t{x} * picture::kPixel + picture::kMiddle[0].across,
                     down = std::int64_t{y} * picture::kPixel + picture::kMiddle[0].down;
  std::optional<Sight> sight;
  with_painter(data, [&](const auto& painter) {
    const Seen seen = painter.seen(across, down);
    if (!seen.found) return;
    sight = Sight{seen.ground,
                  seen.position,
                  seen.normal,
                  picture::ray_through(data.view, across, down, data.spacing).step,
                  {}};
    if (!seen.ground) sight->matter = painter.matter(seen.position);
  });
  return sight;
}

}  // namespace voxmelt::render
