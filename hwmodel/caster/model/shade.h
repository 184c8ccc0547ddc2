// The colour of a surface (docs/picture/light.md, sections 3, 5 and 6) is split into the parts that stages
// compute.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "hwmodel/caster/model/arithmetic.h"
#include "hwmodel/caster/model/registers.h"

namespace voxmelt::hwmodel::raycast {

struct MatterBytes {
  std::int32_t liquid = 0, heat = 0, obstacle = 0;
  friend bool operator==(const MatterBytes&, const MatterBytes&) = default;
};
// The `words` are eight, x fastest: liquid + 256 heat + 65536 obstacle.
inline MatterBytes matter_of(const std::uint32_t* words, const Spots& at) {
  const auto byte = [&](int shift) {
    const auto w = [&](std::size_t i) { return std::int64_t{(words[i] >> shift) & 255}; };
    const auto row = [&](std::size_t i) { return blended(w(i), w(i + 1), at.x.weight); };
    return static_cast<std::int32_t>(UInt<8>(
        blended(blended(row(0), row(2), at.y.weight), blended(row(4), row(6), at.y.weight), at.z.weight)));
  };
  return {byte(0), byte(8), byte(16)};
}

using LightWord = std::array<std::uint8_t, 16>;  // cell of light: lamp, open, nothing, glow
struct Light {
  std::int32_t lamp = 255;
  std::array<std::int32_t, 6> open{}, glow{};
  friend bool operator==(const Light&, const Light&) = default;
};
inline Light light_of(const LightWord* words, const Spots& at, bool glow) {
  const auto byte = [&](std::size_t n) {
    const auto row = [&](std::size_t i) { return blended(words[i][n], words[i + 1][n], at.x.weight); };
    return static_cast<std::int32_t>(UInt<8>(
        blended(blended(row(0), row(2), at.y.weight), blended(row(4), row(6), at.y.weight), at.z.weight)));
  };
  Light light;
  light.lamp = byte(0);
  for (std::size_t side = 0; side < 6; ++side) {
    light.open[side] = byte(1 + side);
    light.glow[side] = glow ? byte(8 + side) : 0;
  }
  return light;
}
// Returns six sides as seen along a direction.
inline std::int64_t seen(const std::array<std::int32_t, 6>& sides, Vec r) {
  const auto part = [&](std::int64_t c, std::size_t axis) {
    return ((c * c) >> 14) * sides[2 * axis + (c < 0 ? 1 : 0)];
  };
  return std::min<std::int64_t>((part(r.x, 0) + part(r.y, 1) + part(r.z, 2)) >> 14, 255);
}

// Holds what reaches a surface. A normal that is a unit too long may get an ambient light of -1.
struct Arriving {
  std::int64_t lamp = 0, facing = 0, lit = 0;
  Rgb light{};
};
inline Arriving arriving_of(const LookRegisters& look, Vec normal, const Light& light, bool by_glow) {
  Arriving arriving;
  arriving.lamp = UInt<9>(whole(light.lamp));
  arriving.facing = SInt<16>(cosine(normal, look.to_light));
  arriving.lit =
      UInt<15>((((std::max<std::int64_t>(arriving.facing + 2458, 0) * 14247) >> 14) * arriving.lamp) >> 8);
  const std::int64_t open = whole(seen(light.open, normal)), glow = by_glow ? seen(light.glow, normal) : 0;
  constexpr Rgb kGlow{6144, 1966, 369};
  for (std::size_t c = 0; c < 3; ++c) {
    const std::int64_t ambient =
        look.from_below[c] + (((look.from_above[c] - look.from_below[c]) * (normal.y + (1 << 14))) >> 15);
    arriving.light[c] = static_cast<std::int32_t>(
        SInt<17>(((ambient * open) >> 8) + ((look.lamp[c] * arriving.lit) >> 14) + ((kGlow[c] * glow) >> 5)));
  }
  return arriving;
}

// Holds what matter is at a place, mixed.
struct Mixture {
  std::int32_t l = 0, w = 0;
  Material material;
  Rgb emission{};
};
inline Material mixed(const Material& a, const Material& b, std::int64_t share) {
  return {mixed(a.diffuse, b.diffuse, share), mixed(a.mirror, b.mirror, share),
          mixed(a.highlight, b.highlight, share), mixed(a.gloss, b.gloss, share)};
}
inline Mixture mixture_of(const LookRegisters& look, const MatterBytes& bytes) {
  Mixture mixture;
  mixture.l = static_cast<std::int32_t>(UInt<12>(16 * bytes.liquid + (bytes.liquid >> 4)));
  mixture.w = std::clamp(73 * (bytes.obstacle - 148), 0, 4096);
  // A multiplexer before the mixer. The gloss of all solids is the same.
  const Material& solid = look.tinted ? look.tints[static_cast<std::size_t>(bytes.heat)] : look.solid;
  mixture.material = mixed(solid, look.liquid, mixture.l);
  if (look.glow) {
    const std::size_t heat = bytes.heat;
    for (std::size_t c = 0; c < 3; ++c) {
      mixture.material.diffuse[c] += (look.glow_crust[heat][c] * mixture.l) >> 12;
      mixture.emission[c] = (((look.glow_light[heat][c] * mixture.l) >> 12) * (4096 - mixture.w)) >> 12;
    }
  }
  mixture.material = mixed(mixture.material, look.obstacle, mixture.w);
  check_wires<13>(mixture.material.diffuse);
  check_wires<13>(mixture.material.mirror);
  check_wires<13>(mixture.material.highlight);
  check_wires<14>(mixture.emission);
  return mixture;
}

// Holds how much a surface mirrors, and of what.
struct Mirrored {
  std::int64_t peak = 0, eye = 0, more = 0, free = 0;
  Vec reflected;
  Rgb around{};
};
inline std::int64_t highlight_at(const std::array<std::uint16_t, 1026>& table, std::int64_t cosine) {
  const std::size_t i = cosine >> 4;
  return table[i] + (((table[i + 1] - table[i]) * (cosine & 15)) >> 4);
}
inline Mirrored mirrored_of(const LookRegisters& look, Vec normal, Vec to_eye, const Light& light,
                            const Arriving& arriving, const Mixture& mixture) {
  Mirrored mirrored;
  const Vec half = unit_of(look.to_light + to_eye);
  const std::int64_t shine = std::clamp<std::int64_t>(cosine(normal, half), 0, 1 << 14);
  const std::int64_t unlit =
      mixed(highlight_at(look.highlight, shine), highlight_at(look.dull_highlight, shine), mixture.w);
  mirrored.peak = UInt<13>((((unlit * smooth(0, 1024, arriving.facing >> 2)) >> 12) * arriving.lamp) >> 8);

  mirrored.eye = std::clamp<std::int64_t>(cosine(normal, to_eye), 0, 1 << 14);
  const std::int64_t a = (1 << 14) - mirrored.eye, a2 = (a * a) >> 14, a4 = (a2 * a2) >> 14;
  const std::int64_t graze = (a4 * a) >> 14;
  mirrored.more = UInt<13>((graze * mixture.material.gloss) >> 14);
  const std::int64_t twice = (2 * dot(normal, to_eye)) >> 14;
  mirrored.reflected = on_wires<16>(((normal * twice) >> 14) - to_eye);
  mirrored.free =
      614 + ((whole(seen(light.open, mirrored.reflected)) * whole(seen(light.open, normal)) * 3482) >> 16);

  const std::int64_t entry = std::clamp<std::int64_t>(mirrored.reflected.y + (1 << 14), 0, 1 << 15) >> 4;
  const std::uint32_t packed = look.surroundings[entry];
  const std::int32_t red = packed & 2047, green = (packed >> 11) & 2047, blue = packed >> 22;
  const Rgb surroundings{2 * red, 2 * green, 4 * blue};
  const std::int64_t lamp =
      smooth(look.lamp_low, look.lamp_high, cosine(mirrored.reflected, look.to_light) >> 2);
  const std::int64_t strip = smooth(look.strip_low, 3973, cosine(mirrored.reflected, look.to_strip) >> 2);
  constexpr Rgb kLamp{9830, 9626, 9216}, kStrip{2867, 3072, 3482};
  for (std::size_t c = 0; c < 3; ++c)
    mirrored.around[c] = static_cast<std::int32_t>(
        UInt<15>(surroundings[c] + ((kLamp[c] * lamp) >> 12) + ((kStrip[c] * strip) >> 12)));
  return mirrored;
}

// Returns the part of the arriving light that a surface scatters.
inline Rgb scattered_color(const Arriving& arriving, const Rgb& color) {
  Rgb result{};
  for (std::size_t c = 0; c < 3; ++c)
    result[c] = static_cast<std::int32_t>((std::int64_t{arriving.light[c]} * color[c]) >> 12);
  return result;
}
// Returns the light that it mirrors, with its highlight.
inline Rgb gleam_of(const Mixture& mixture, const Mirrored& mirror) {
  Rgb gleam{};
  for (std::size_t c = 0; c < 3; ++c) {
    const std::int64_t fresnel =
        mixture.material.mirror[c] + (((4096 - mixture.material.mirror[c]) * mirror.more) >> 12);
    gleam[c] =
        static_cast<std::int32_t>(UInt<15>(((mixture.material.highlight[c] * mirror.peak) >> 12) +
                                           ((((mirror.around[c] * mirror.free) >> 12) * fresnel) >> 12)));
  }
  return gleam;
}
inline Rgb matter_color(const Arriving& arriving, const Mixture& mixture, const Mirrored& mirror) {
  const Rgb body = scattered_color(arriving, mixture.material.diffuse), gleam = gleam_of(mixture, mirror);
  Rgb sum{};
  for (std::size_t c = 0; c < 3; ++c)
    sum[c] = static_cast<std::int32_t>(
        SInt<18>(std::int64_t{body[c]} + gleam[c] +
                 ((mixture.emission[c] * (2540 + ((1556 * mirror.eye) >> 14))) >> 12)));
  return sum;
}

}  // namespace voxmelt::hwmodel::raycast
