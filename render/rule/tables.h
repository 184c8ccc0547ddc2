// A picture needs tables for the highlight, the surroundings, the glow and the tones of solids
// (docs/picture/light.md, section 2).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "render/rule/look.h"

namespace voxmelt::picture {

// Returns x^exponent, with x in 2^15. Every product is rounded, from the exponent's highest bit down.
VOXMELT_RULE std::int32_t power(std::int32_t x, std::int32_t exponent) {
  std::int64_t result = std::int64_t{1} << 15;
  for (int bit = bits_of(exponent) - 1; bit >= 0; --bit) {
    result = rounded(result * result, 15);
    if (((exponent >> bit) & 1) != 0) result = rounded(result * x, 15);
  }
  return static_cast<std::int32_t>(result);
}

// Holds the highlight by the cosine between normal and halfway vector. Entry i is at i / 1024, and kLight at
// most.
using Highlight = std::array<std::uint16_t, 1026>;
VOXMELT_RULE Highlight highlight_of(std::int32_t exponent) {
  Highlight table{};
  for (std::int32_t i = 0; i <= 1024; ++i)
    table[i] = static_cast<std::uint16_t>(power(32 * i, exponent) >> 3);
  table[1025] = table[1024];
  return table;
}

// Interpolates between two entries, for a cosine 0 .. kLength.
VOXMELT_RULE std::int32_t highlight_at(const Highlight& table, std::int32_t cosine) {
  const std::size_t i = cosine >> 4;
  return table[i] + (((table[i + 1] - table[i]) * (cosine & 15)) >> 4);
}

// Holds the view of a mirror in a photographer's studio, which is sky and ground by height. The blur goes
// from 0 (sharp) to kLight (dull). Red and green have 11 bits and blue 10, and all ones is 1.
using Surroundings = std::array<std::uint32_t, 2049>;

VOXMELT_RULE std::int32_t blur_of(std::int32_t shininess) {
  return std::clamp(6 * kLight / (shininess + 6), 205, kLight);
}

VOXMELT_RULE Surroundings surroundings_of(const Look& look) {
  constexpr Color kHorizon{3768, 3850, 3973}, kZenith{901, 1065, 1352};
  const std::int32_t blur = blur_of(look.shininess);
  Surroundings table{};
  for (std::int32_t i = 0; i <= 2048; ++i) {
    const std::int32_t height = 4 * (i - 1024);  // in kLight
    const Color sky =
        mixed(kHorizon, kZenith, smooth_light(-times(819, blur), 3072 + times(1229, blur), height));
    const Color below =
        mixed(times(look.ground, 3072), times(look.ground, 1024), smooth_light(0, 2867, -height));
    const std::int32_t edge = times(1229, blur);
    const Color seen = mixed(below, sky, smooth_light(-246 - edge, 246 + edge, height));
    const auto part = [](std::int32_t value, std::int32_t most) {
      return static_cast<std::uint32_t>(std::clamp((value * most + kLight / 2) >> kLightBits, 0, most));
    };
    table[i] = part(seen[0], 2047) | part(seen[1], 2047) << 11 | part(seen[2], 1023) << 22;
  }
  return table;
}

// Holds the light and the crust of glowing liquid by its heat, 0 .. 255.
struct Glow {
  std::array<Color, 256> light, crust;
};

VOXMELT_RULE Glow glow_table() {
  constexpr Color kCold{139, 119, 115}, kHot{164, 57, 33};
  Glow table{};
  for (std::int32_t i = 0; i < 256; ++i) {
    const std::int64_t h = (std::int64_t{i} * 65536 + 127) / 255;  // the heat in 2^16
    const auto product = [](std::int64_t a, std::int64_t b) { return rounded(a * b, 16); };
    const std::int64_t root = square_root(h << 16), fourth = square_root(root << 16);
    const std::int64_t h2 = product(h, h), h4 = product(h2, h2), h8 = product(h4, h4);
    const auto scaled = [](std::int64_t a, std::int64_t by) {
      return static_cast<std::int32_t>(rounded(a * by, 16));
    };
    const std::size_t at = i;
    table.light[at] = {scaled(product(product(h, root), fourth), 9421), scaled(product(h4, root), 4710),
                       scaled(h8, 819)};
    table.crust[at] = mixed(kCold, kHot, static_cast<std::int32_t>(h >> 4));
  }
  return table;
}

// Holds what solids are made of by their tone, 0 .. 255.
using Tints = std::array<Material, 256>;

// Returns the colour of a tone. The colours of the look lie at equal distances. Those between two are mixed,
// and an eighth of the distance belongs to each alone, so that borders are not wider than the filter needs.
VOXMELT_RULE Color tint_at(const Look& look, std::int32_t tone) {
  const std::int32_t last = look.tint_count - 1;
  std::int32_t next = 1;
  while (next < last && 255 * next / last <= tone) ++next;
  const std::int32_t low = 255 * (next - 1) / last, high = 255 * next / last;
  const std::size_t to = next;
  const std::int32_t share = smooth_light(kLight / 8, 7 * kLight / 8, kLight * (tone - low) / (high - low));
  return mixed(look.tints[to - 1], look.tints[to], share);
}

VOXMELT_RULE Tints tint_table(const Look& look, std::int32_t specular, Color lamp) {
  Tints table{};
  if (look.tinted())
    for (std::int32_t i = 0; i < 256; ++i)
      table[i] = material_of(tint_at(look, i), specular, look.metallic, lamp);
  return table;
}

}  // namespace voxmelt::picture
