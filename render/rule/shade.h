// A surface gets its colour here (docs/picture/light.md, section 6).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "render/rule/clear.h"
#include "render/rule/light_grid.h"
#include "render/rule/look.h"
#include "render/rule/matter.h"
#include "render/rule/tables.h"
#include "render/rule/watch.h"

namespace voxmelt::picture {

// Holds the numbers that the shading of a whole picture shares.
struct Paint {
  Vector to_light;                   // direction of the lamp, length kLength
  Vector to_strip;                   // direction of a second light, opposite of the lamp
  Color lamp{};                      // light of the lamp
  Color from_below{}, from_above{};  // ambient light
  Material solid, liquid, obstacle;
  bool glow = false;
  bool clear = false;
  bool tinted = false;     // solids have the material of their tone
  Color losses{};          // losses in clear matter
  std::int32_t frost = 0;  // share that its surfaces scatter
  std::int32_t lamp_low = 0, lamp_high = 0,
               strip_low = 0;               // limits of the mirrored lights, in kLight
  Highlight highlight{}, dull_highlight{};  // for matter, and for obstacles
  Surroundings surroundings{};
  Glow glow_colors{};
  Tints tints{};
  Passing passing{};
};

inline constexpr std::int32_t kStripHigh = 3973;     // 0.97
inline constexpr Color kGlowLight{6144, 1966, 369};  // light that glowing liquid throws on its surroundings
inline constexpr Color kMirroredLamp{9830, 9626, 9216}, kMirroredStrip{2867, 3072, 3482};

VOXMELT_RULE Paint paint_of(const Look& look, const Lamp& lamp) {
  Paint paint;
  paint.to_light = unit_of(lamp.direction);
  paint.to_strip = unit_of({-paint.to_light.x, 5734, -paint.to_light.z});
  paint.lamp = times(kLampColor, times(4915, kLight - lamp.ambient));
  paint.from_below = times(times(look.ground, 3686), lamp.ambient);
  paint.from_above = times(kSkyColor, lamp.ambient);
  paint.solid = material_of(look.solid, times(look.specular, 2867), look.metallic, paint.lamp);
  paint.liquid = material_of(look.liquid, look.specular, look.metallic, paint.lamp);
  paint.obstacle = material_of(mixed(look.ground, Color{kLight, kLight, kLight}, 492), 123, 0, paint.lamp);
  paint.glow = look.glow;
  if (look.glow) {  // molten rock is dull, and its colour is in the table
    paint.solid = material_of(look.solid, times(look.specular, 2867), 0, paint.lamp);
    paint.liquid = material_of(Color{}, times(look.specular, 492), 0, paint.lamp);
  }
  paint.clear = is_clear(look);
  if (paint.clear) {
    paint.losses = losses_of(look.clear);
    paint.frost = look.frost;
    paint.passing = passing_table();
  }
  const std::int32_t blur = blur_of(look.shininess);
  paint.lamp_low = 3523 - times(1229, blur);
  paint.lamp_high = 3809 + times(287, blur);
  paint.strip_low = 3277 - times(1229, blur);
  paint.highlight = highlight_of(look.shininess);
  paint.dull_highlight = highlight_of(12);
  paint.surroundings = surroundings_of(look);
  paint.glow_colors = glow_table();
  paint.tinted = look.tinted();
  paint.tints = tint_table(look, times(look.specular, 2867), paint.lamp);
  return paint;
}

VOXMELT_RULE std::int32_t cosine(Vector a, Vector b) {
  return static_cast<std::int32_t>(dot(a, b) >> kNormalBits);
}

// Returns the lamp's and the ambient light that reach a surface, before its own colour. kLight is 1.
template <class Watch = Silent>
VOXMELT_RULE Color arriving(const Paint& paint, Vector normal, const Light& light, bool lit_by_glow,
                            Watch watch = {}) {
  constexpr std::int32_t kWrap = 2458, kPressed = 14247;  // 0.15 and 1 / 1.15: light bleeds a little around
  const std::int32_t lamp = light.lamp + (light.lamp >> 7);
  const std::int32_t facing = cosine(normal, paint.to_light);
  const std::int32_t lit = (((std::max(facing + kWrap, 0) * kPressed) >> kNormalBits) * lamp) >> 8;
  const std::int32_t seen = seen_along(light.open, normal), open = seen + (seen >> 7);
  const std::int32_t glow = lit_by_glow ? seen_along(light.glow, normal) : 0;
  const auto up = static_cast<std::int32_t>(normal.y) + kLength;  // 0 .. 2
  watch(Stage::arriving, "lamp", lamp);
  watch(Stage::arriving, "facing", facing);
  watch(Stage::arriving, "lit", lit);
  watch(Stage::arriving, "seen open", seen);
  watch(Stage::arriving, "seen glow", glow);
  Color ambient{}, sum{};
  for (std::size_t c = 0; c < 3; ++c) {
    ambient[c] =
        paint.from_below[c] + (((paint.from_above[c] - paint.from_below[c]) * up) >> (kNormalBits + 1));
    sum[c] =
        ((ambient[c] * open) >> 8) + ((paint.lamp[c] * lit) >> kNormalBits) + ((kGlowLight[c] * glow) >> 5);
  }
  watch(Stage::arriving, "ambient", ambient);
  watch(Stage::arriving, "arriving", sum);
  return sum;
}

// Returns the light that is mirrored from a direction. It comes from sky or ground, the lamp and the strip.
template <class Watch = Silent>
VOXMELT_RULE Color mirrored(const Paint& paint, Vector direction, Watch watch = {}) {
  const auto height =
      static_cast<std::int32_t>(std::clamp<std::int64_t>(direction.y + kLength, 0, 2 * kLength));
  const std::uint32_t packed = paint.surroundings[height >> 4];
  const std::int32_t red = packed & 2047, green = (packed >> 11) & 2047, blue = packed >> 22;
  const Color around{red << 1, green << 1, blue << 2};
  const auto step = [&](Vector light, std::int32_t low, std::int32_t high) {
    return smooth_light(low, high, cosine(direction, light) >> 2);
  };
  const std::int32_t lamp = step(paint.to_light, paint.lamp_low, paint.lamp_high);
  const std::int32_t strip = step(paint.to_strip, paint.strip_low, kStripHigh);
  Color sum{};
  for (std::size_t c = 0; c < 3; ++c)
    sum[c] =
        around[c] + ((kMirroredLamp[c] * lamp) >> kLightBits) + ((kMirroredStrip[c] * strip) >> kLightBits);
  watch(Stage::mirror, "entry", height >> 4);
  watch(Stage::mirror, "surroundings", around);
  watch(Stage::mirror, "lamp", lamp);
  watch(Stage::mirror, "strip", strip);
  watch(Stage::mirror, "around", sum);
  return sum;
}

VOXMELT_RULE Material mixed(const Material& a, const Material& b, std::int32_t share) {
  return {mixed(a.diffuse, b.diffuse, share), mixed(a.mirror, b.mirror, share),
          mixed(a.highlight, b.highlight, share), mixed(a.gloss, b.gloss, share)};
}

// Holds the parts of the light from a surface of matter.
struct Shine {
  Color mirrored{};           // mirrored light, with the highlight
  Color scattered{};          // scattered part of the arriving light
  Color emission{};           // light of glowing liquid
  std::int32_t more = 0;      // share of the light from behind that the surface mirrors instead
  std::int32_t obstacle = 0;  // the share of obstacles in it
};

// Returns how much obstacles count. They begin at a share of 148 and count fully above 204. So matter half a
// cell deep hides them, and no blur shows.
VOXMELT_RULE std::int32_t obstacle_share(Matter matter) {
  return std::clamp((matter.obstacle - 148) * 73, 0, kLight);
}

// Holds the material of a surface, and the light that it sends by itself.
struct Substance {
  Material material;
  Color emission{};
};
VOXMELT_RULE const Material& solid_of(const Paint& paint, Matter matter) {
  return paint.tinted ? paint.tints[static_cast<std::size_t>(matter.heat)] : paint.solid;
}
template <class Watch = Silent>
VOXMELT_RULE Substance substance_of(const Paint& paint, Matter matter, std::int32_t obstacle,
                                    Watch watch = {}) {
  const std::int32_t liquid = (matter.liquid << 4) + (matter.liquid >> 4);  // 255 is kLight - 1
  Substance substance{mixed(solid_of(paint, matter), paint.liquid, liquid)};
  if (paint.glow) {
    const std::size_t heat = matter.heat;
    for (std::size_t c = 0; c < 3; ++c) {
      substance.material.diffuse[c] += (paint.glow_colors.crust[heat][c] * liquid) >> kLightBits;
      substance.emission[c] =
          (((paint.glow_colors.light[heat][c] * liquid) >> kLightBits) * (kLight - obstacle)) >> kLightBits;
    }
  }
  substance.material = mixed(substance.material, paint.obstacle, obstacle);
  watch(Stage::material, "l", liquid);
  watch(Stage::material, "w", obstacle);
  watch(Stage::material, "diffuse", substance.material.diffuse);
  watch(Stage::material, "mirror", substance.material.mirror);
  watch(Stage::material, "highlight", substance.material.highlight);
  watch(Stage::material, "gloss", substance.material.gloss);
  watch(Stage::material, "emission", substance.emission);
  return substance;
}

// Returns the light towards the eye. `to_eye` has kLength. `normal` is on the eye's side, and `out` points
// out of the matter. They are opposite if the eye looks at a surface from within.
template <class Watch = Silent>
VOXMELT_RULE Shine shine_of(const Paint& paint, Vector normal, Vector out, Vector to_eye, const Light& light,
                            Matter matter, Watch watch = {}) {
  const std::int32_t obstacle = obstacle_share(matter);
  const auto [material, emission] = substance_of(paint, matter, obstacle, watch);
  const Color arrives = arriving(paint, out, light, paint.glow && obstacle > 0, watch);
  const std::int32_t lamp = light.lamp + (light.lamp >> 7);
  const std::int32_t facing = cosine(normal, paint.to_light);
  const Vector halfway = unit_of(paint.to_light + to_eye, watch);
  const std::int32_t bright = std::clamp(cosine(normal, halfway), 0, kLength);
  std::int32_t peak = highlight_at(paint.highlight, bright);
  if (obstacle > 0) peak = mixed(peak, highlight_at(paint.dull_highlight, bright), obstacle);
  watch(Stage::mirror, "half", halfway);
  watch(Stage::mirror, "shine", bright);
  watch(Stage::mirror, "unlit peak", peak);
  peak = (((peak * smooth_light(0, 1024, facing >> 2)) >> kLightBits) * lamp) >> 8;

  const std::int32_t eye = std::clamp(cosine(normal, to_eye), 0, kLength);
  const std::int32_t away = kLength - eye;
  const std::int32_t away2 = (away * away) >> kNormalBits, away4 = (away2 * away2) >> kNormalBits;
  const std::int32_t graze = (away4 * away) >> kNormalBits;
  const std::int32_t more = (graze * material.gloss) >> kNormalBits;
  const std::int64_t twice = 2 * dot(normal, to_eye) >> kNormalBits;
  const Vector reflected = ((normal * twice) >> kNormalBits) - to_eye;
  watch(Stage::mirror, "peak", peak);
  watch(Stage::mirror, "eye", eye);
  watch(Stage::mirror, "a2", away2);
  watch(Stage::mirror, "a4", away4);
  watch(Stage::mirror, "graze", graze);
  watch(Stage::mirror, "more", more);
  watch(Stage::mirror, "r", reflected);
  const Color around = mirrored(paint, reflected, watch);
  const std::int32_t open = seen_along(light.open, normal), free = seen_along(light.open, reflected);
  // The mirrored light is at most 85 % hidden.
  const std::int32_t seen = 614 + (((free + (free >> 7)) * (open + (open >> 7)) * 3482) >> 16);

  watch(Stage::mirror, "seen open by r", free);
  watch(Stage::mirror, "free", seen);
  Shine shine{{}, {}, {}, more, obstacle};
  Color fresnel{}, mirror{};
  for (std::size_t c = 0; c < 3; ++c) {
    fresnel[c] = material.mirror[c] + (((kLight - material.mirror[c]) * more) >> kLightBits);
    mirror[c] = (((around[c] * seen) >> kLightBits) * fresnel[c]) >> kLightBits;
    shine.mirrored[c] = ((material.highlight[c] * peak) >> kLightBits) + mirror[c];
    shine.scattered[c] = (arrives[c] * material.diffuse[c]) >> kLightBits;
    shine.emission[c] = (emission[c] * (2540 + ((1556 * eye) >> kNormalBits))) >> kLightBits;
  }
  watch(Stage::colour, "fresnel", fresnel);
  watch(Stage::colour, "mirrored", mirror);
  watch(Stage::colour, "own", shine.emission);
  return shine;
}

// Returns the light that clear matter scatters at a place in it.
template <class Watch = Silent>
VOXMELT_RULE Color inner_color(const Paint& paint, const Light& light, Matter matter, Watch watch = {}) {
  const std::int32_t liquid = (matter.liquid << 4) + (matter.liquid >> 4);
  const std::int32_t obstacle = obstacle_share(matter);
  const Color diffuse = mixed(mixed(solid_of(paint, matter).diffuse, paint.liquid.diffuse, liquid),
                              paint.obstacle.diffuse, obstacle);
  Color color = inner_light(paint.lamp, paint.from_below, paint.from_above, light);
  watch(Stage::material, "l", liquid);
  watch(Stage::material, "w", obstacle);
  watch(Stage::material, "diffuse", diffuse);
  watch(Stage::clear, "inner", color);
  for (std::size_t c = 0; c < 3; ++c) color[c] = (color[c] * diffuse[c]) >> kLightBits;
  return color;
}

template <class Watch = Silent>
VOXMELT_RULE Color matter_color(const Paint& paint, Vector normal, Vector to_eye, const Light& light,
                                Matter matter, Watch watch = {}) {
  const Shine shine = shine_of(paint, normal, normal, to_eye, light, matter, watch);
  Color sum{};
  for (std::size_t c = 0; c < 3; ++c) sum[c] = shine.mirrored[c] + shine.scattered[c] + shine.emission[c];
  watch(Stage::colour, "colour", sum);
  return sum;
}

// Returns the light from the ground, which is dull.
template <class Watch = Silent>
VOXMELT_RULE Color ground_color(const Paint& paint, Vector normal, const Light& light, Color color,
                                Watch watch = {}) {
  const Color arrives = arriving(paint, normal, light, paint.glow, watch);
  Color sum{};
  for (std::size_t c = 0; c < 3; ++c) sum[c] = (arrives[c] * color[c]) >> kLightBits;
  watch(Stage::colour, "colour", sum);
  return sum;
}

}  // namespace voxmelt::picture
