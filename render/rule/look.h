// The look of a picture is held in integers, with the numbers that its shading needs (docs/picture/light.md,
// section 1).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "render/rule/fixed_point.h"
#include "render/rule/normal.h"
#include "render/rule/watch.h"

namespace voxmelt::picture {

using Color = std::array<std::int32_t, 3>;  // red, green, blue: linear light, kLight is 1

inline constexpr int kLightBits = 12;
inline constexpr std::int32_t kLight = 1 << kLightBits;
inline constexpr int kClearBits = 6;
inline constexpr std::size_t kMostTints = 16;

// Holds the values of a scene file, times kLight to the nearest integer.
struct Look {
  Color solid{}, liquid{}, ground{}, background{};
  std::int32_t shininess = 1;  // not scaled, 1 or more
  std::int32_t specular = 0, metallic = 0;
  Color clear{};           // half of the light passes this way, 2^kClearBits is a cell; all 0: opaque
  std::int32_t frost = 0;  // share that a surface of clear matter scatters
  bool glow = false;
  std::int32_t glow_cold = 0, glow_hot = 0;  // temperatures, 65536 is the scene's range
  // Holds the colours of solids in the order of their tones. With fewer than two, all have the colour
  // `solid`.
  std::array<Color, kMostTints> tints{};
  std::int32_t tint_count = 0;

  constexpr bool tinted() const { return tint_count > 1; }
};

struct Lamp {
  Vector direction;  // towards the light, of any length but 0, components within 2^40
  std::int32_t ambient = 0;
};

// Returns a b / 2^12 to the nearest integer.
VOXMELT_RULE std::int32_t times(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(rounded(std::int64_t{a} * b, kLightBits));
}
VOXMELT_RULE Color times(Color a, std::int32_t b) { return {times(a[0], b), times(a[1], b), times(a[2], b)}; }

// Mixes from a (share 0) to b (share kLight).
VOXMELT_RULE std::int32_t mixed(std::int32_t a, std::int32_t b, std::int32_t share) {
  return a + times(b - a, share);
}
VOXMELT_RULE Color mixed(Color a, Color b, std::int32_t share) {
  return {mixed(a[0], b[0], share), mixed(a[1], b[1], share), mixed(a[2], b[2], share)};
}

// Returns 0 below `low`, kLight above `high`, and 3 t^2 - 2 t^3 between.
VOXMELT_RULE std::int32_t smooth_light(std::int32_t low, std::int32_t high, std::int32_t at) {
  const std::int64_t t =
      std::clamp<std::int64_t>(floor_divided(std::int64_t{at - low} * kLight, high - low), 0, kLight);
  return static_cast<std::int32_t>((t * t * (3 * kLight - 2 * t)) >> (2 * kLightBits));
}

// Returns a vector of any length, brought to kLength. The vector 0 stays 0. One bit less than `unit` can take
// is kept, because the shift rounds down and may add one to a magnitude.
template <class Watch = Silent>
VOXMELT_RULE Vector unit_of(Vector a, Watch watch = {}) {
  const int bits = bits_of(largest(a));
  return unit(bits > 15 ? a >> (bits - 14) : a, watch);
}

// Describes how matter reflects. Metals mirror their surroundings and have next to no colour of their own.
struct Material {
  Color diffuse{};         // share of the arriving light that is scattered
  Color mirror{};          // share of the mirrored light, seen from ahead
  Color highlight{};       // light of the lamp's highlight
  std::int32_t gloss = 0;  // additional share that is mirrored at grazing angles
};

inline constexpr Color kLampColor{4342, 4096, 3768};
inline constexpr Color kSkyColor{3850, 4096, 4424};

VOXMELT_RULE Material material_of(Color color, std::int32_t specular, std::int32_t metallic, Color lamp) {
  Material material;
  material.diffuse = times(color, kLight - times(metallic, 3482));  // 0.85 of a metal's is lost
  const std::int32_t dull = times(specular, 328);                   // 0.08
  material.mirror = mixed(Color{dull, dull, dull}, color, metallic);
  const Color tint = mixed(Color{kLight, kLight, kLight}, color, metallic);
  for (std::size_t c = 0; c < 3; ++c) material.highlight[c] = times(times(tint[c], lamp[c]), specular);
  material.gloss = times(mixed(times(specular, 4915), kLight, metallic), 2867);  // 1.2 and 0.7
  return material;
}

}  // namespace voxmelt::picture
