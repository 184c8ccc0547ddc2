// Tiles get the wrong pixels, pixels the wrong bytes, and bytes the wrong place.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "hwmodel/caster/faults/planted.h"
#include "hwmodel/caster/model/tile_stages.h"

namespace voxmelt::hwmodel::raycast {

class TileFaults : public Planted {
 public:
  using Planted::Planted;

  template <class PixelsOf>
  void chosen(const TileJob& job, int most, const PixelsOf& pixels_of, std::uint64_t& pixels) {
    if (!job.second) return;
    std::uint64_t wrong = pixels;
    if (armed(Fault::tiles_threshold)) wrong = pixels_of(most - 1, 0b1111u);
    if (armed(Fault::tiles_neighbour)) wrong = pixels_of(most, 0b0111u);
    if (wrong == pixels || wrong == 0) return;  // without pixels nothing leaves the stage
    const int first = std::countr_zero(wrong ^ pixels);
    pixels = wrong;
    strike("tiles", {job.x + first % kTileSide, job.y + first / kTileSide, 0, 0});
  }

  void pressed(const LookRegisters& look, const Surface& surface, PressedToken& token) {
    if (!armed(Fault::press_tone) || surface.kind == Surface::Kind::background) return;
    Rgb wrong{};
    for (std::size_t c = 0; c < 3; ++c) wrong[c] = look.tone[std::clamp(surface.sum[c] + 1, 0, 12287)];
    replace("press", token.id, token.pressed, wrong);
  }

  void totalled(const LookRegisters& look, const Rgb& sum, int samples, PixelToken& pixel) {
    std::array<std::uint8_t, 3> wrong = pixel.bytes;
    if (armed(Fault::pixel_channels)) std::swap(wrong[0], wrong[2]);
    for (std::size_t c = 0; c < 3; ++c) {
      if (armed(Fault::pixel_mean)) wrong[c] = look.bytes[sum[c] / samples];
      if (armed(Fault::pixel_byte))
        wrong[c] = look.bytes[std::min(static_cast<std::size_t>((sum[c] + samples / 2) / samples) + 1,
                                       look.bytes.size() - 1)];
    }
    replace("pixel", pixel.id, pixel.bytes, wrong);
  }

  void written(const FrameRegisters& frame, const TileBuffer& buffer, int burst, LineRequest& to) {
    const std::int64_t tile = (to.address - frame.write) / kTileBytes;
    if (armed(Fault::write_place)) {
      // If all pixels look the same, the next tile might, too.
      const bool flat = std::equal(to.data.begin() + 3, to.data.end(), to.data.begin());
      if (flat || tile + 1 == std::int64_t{frame.tiles_x} * frame.tiles_y) return;
      to.address += kTileBytes;
      strike_tile(frame, tile + 1);
    }
    if (armed(Fault::write_burst)) {
      auto wrong = to.data;
      std::memcpy(wrong.data(), buffer.bytes.data() + kBurst * ((burst + 1) % (kTileBytes / kBurst)), kBurst);
      if (wrong == to.data) return;
      to.data = wrong;
      strike_tile(frame, tile);
    }
  }

 private:
  void strike_tile(const FrameRegisters& frame, std::int64_t tile) {
    strike("write", {static_cast<std::int32_t>(tile % frame.tiles_x) * kTileSide,
                     static_cast<std::int32_t>(tile / frame.tiles_x) * kTileSide, 0, 0});
  }
};

}  // namespace voxmelt::hwmodel::raycast
