// Light arrives at the surfaces of a packet (rule/light_grid.h).
#pragma once

#include <cstdint>

#include "render/packet/field_packet.h"

namespace voxmelt::render {

template <class Arch>
struct LightPacket : Packet<Arch> {
  using P = Packet<Arch>;
  using typename P::L;
  using typename P::Triple;
  using typename P::V;

  // Holds four bytes a lane, in the order of LightBytes.
  struct Light {
    V lamp_open, open, glow, more_glow;
  };

  // Returns the light at `position`, in 2^-20 cells of the grid and not of the lattice.
  VOXMELT_WORDS Light at(const LightData& light, bool glow, Triple position) {
    struct Axis {
      V below, above, weight;
    };
    const auto axis = [&](V p, std::int64_t count) {
      const V place = (p >> light.shift) + static_cast<std::int32_t>(picture::kToPlace);
      const V cell = place >> 20;
      const auto most = static_cast<std::int32_t>(count - 1);
      return Axis{L::clamp(cell, 0, most), L::clamp(cell + 1, 0, most), (place >> 12) & 255};
    };
    const Axis x = axis(position.x, light.count.x), y = axis(position.y, light.count.y),
               z = axis(position.z, light.count.z);
    const auto wide = static_cast<std::int32_t>(light.count.x),
               high = static_cast<std::int32_t>(light.count.y);
    const V rows[4] = {(z.below * high + y.below) * wide, (z.below * high + y.above) * wide,
                       (z.above * high + y.below) * wide, (z.above * high + y.above) * wide};
    const auto word = [&](int which) {
      V along[4];
      for (int i = 0; i < 4; ++i) {
        const std::uint8_t* from = light.cells + 4 * which;
        along[i] =
            FieldPacket<Arch>::blend_bytes(L::template gather<8>(from, 2 * (rows[i] + x.below)),
                                           L::template gather<8>(from, 2 * (rows[i] + x.above)), x.weight);
      }
      return FieldPacket<Arch>::blend_bytes(FieldPacket<Arch>::blend_bytes(along[0], along[1], y.weight),
                                            FieldPacket<Arch>::blend_bytes(along[2], along[3], y.weight),
                                            z.weight);
    };
    Light result{word(0), word(1), V{}, V{}};
    if (glow) {
      result.glow = word(2);
      result.more_glow = word(3);
    }
    return result;
  }

  // Returns the place one cell of light in front of a surface.
  VOXMELT_WORDS Triple before(Triple position, Triple normal, int shift) {
    return position + (normal << (picture::kPositionBits - picture::kNormalBits + shift));
  }

  VOXMELT_WORDS V byte(V word, int i) { return (word >> (8 * i)) & 255; }

  VOXMELT_WORDS V lamp(const Light& light) { return byte(light.lamp_open, 0); }

  // Returns six sides as seen along a unit vector.
  VOXMELT_WORDS V along(V plus_x, V minus_x, V plus_y, V minus_y, V plus_z, V minus_z, Triple d) {
    const auto part = [](V component, V plus, V minus) {
      return ((component * component) >> 14) * (component < 0 ? minus : plus);
    };
    return L::min(
        (part(d.x, plus_x, minus_x) + part(d.y, plus_y, minus_y) + part(d.z, plus_z, minus_z)) >> 14,
        L::set(255));
  }
  VOXMELT_WORDS V open(const Light& light, Triple d) {
    return along(byte(light.lamp_open, 1), byte(light.lamp_open, 2), byte(light.lamp_open, 3),
                 byte(light.open, 0), byte(light.open, 1), byte(light.open, 2), d);
  }
  VOXMELT_WORDS V glow(const Light& light, Triple d) {
    return along(byte(light.glow, 0), byte(light.glow, 1), byte(light.glow, 2), byte(light.glow, 3),
                 byte(light.more_glow, 0), byte(light.more_glow, 1), d);
  }
};

}  // namespace voxmelt::render
