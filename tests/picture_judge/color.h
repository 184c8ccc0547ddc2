// The bytes of matter and the colours of surfaces follow docs/picture/light.md sections 3 and 6.
#pragma once

#include <algorithm>

#include "light.h"

// Holds three bytes of each cell (section 3).
class MatterBytes {
 public:
  MatterBytes(const Input& in, const Look& look, const Field& field, const Levels& the_levels)
      : levels(the_levels) {
    for (Int z = 0; z < in.nz; ++z)
      for (Int y = 0; y < in.ny; ++y)
        for (Int x = 0; x < in.nx; ++x) {
          const Int i = in.cell(x, y, z);
          const bool air = levels.at(x, y, z) == -32640;
          const Int S = field.solid[i], L = field.liquid[i], O = field.obstacle[i];
          liquid.push_back(air || S + L == 0 ? 0 : 255 * L / (S + L));
          heat.push_back(air                        ? 0
                         : look.tones.tints.empty() ? heat_byte(look, L, field.heat[i])
                                                    : tone_byte(S, field.heat[i]));
          obstacle.push_back(air || S + L + O == 0 ? 0 : 255 * O / (S + L + O));
        }
  }
  // Reads at the nearest position between the centres of the outermost cells.
  Int read(const Ints& bytes, Vec p) const {
    const Int half = power_of_two(19), m[3] = {levels.nx, levels.ny, levels.nz};
    for (int axis = 0; axis < 3; ++axis) p.at(axis) = clamped(p.at(axis), half, (m[axis] << 20) - half);
    return blended_eight(p, [&](Int x, Int y, Int z) {
      return levels.inside(x, y, z) ? bytes[(z * levels.ny + y) * levels.nx + x] : Int{0};
    });
  }
  Ints liquid, heat, obstacle;

 private:
  const Levels& levels;
};

inline Int cosine(Vec a, Vec b) { return dot(a, b) >> 14; }

// Returns the arriving light (section 6).
inline Vec arriving_light(const Look& look, const LightBytes& light, Vec n, bool with_glow) {
  const Int facing = cosine(n, look.to_light);
  const Int lit = (((std::max<Int>(facing + 2458, 0) * 14247) >> 14) * whole(light.lamp)) >> 8;
  const Vec ambient =
      look.from_below + (((look.from_above - look.from_below) * (n.y + power_of_two(14))) >> 15);
  Vec arriving = ((ambient * whole(seen(light.open, n))) >> 8) + ((look.lamp * lit) >> 14);
  if (with_glow) arriving = arriving + ((Vec{6144, 1966, 369} * seen(light.glow, n)) >> 5);
  return arriving;
}

inline Vec product(Vec a, Vec b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

inline Vec ground_color(const Look& look, const LightGrid& grid, Vec p, Vec normal, Vec color) {
  const Vec arriving = arriving_light(look, grid.at_surface(p, normal), normal, look.glows);
  return product(arriving, color) >> 12;
}

// Holds l and w of section 6.
struct Shares {
  Int liquid, obstacle;
};
inline Shares shares_of(Int liquid, Int obstacle) {
  return {16 * liquid + (liquid >> 4), clamped(73 * (obstacle - 148), 0, 4096)};
}

// Holds light and matter at a surface, with no eye yet (section 6).
struct Surface {
  Vec n, arriving, emission;
  Int w = 0;
  Material material;
  LightBytes light;
};
inline Surface surface_at(const Look& look, const LightGrid& grid, const MatterBytes& bytes, Vec p, Vec n) {
  const Int heat = bytes.read(bytes.heat, p);
  const auto [l, w] = shares_of(bytes.read(bytes.liquid, p), bytes.read(bytes.obstacle, p + (n << 5)));
  Surface surface;
  surface.n = n;
  surface.w = w;
  Material material = mixed(look.solid_of(heat), look.liquid, l);
  if (look.glows) {
    material.diffuse = material.diffuse + ((look.glow_crust[heat] * l) >> 12);
    surface.emission = (((look.glow_light[heat] * l) >> 12) * (4096 - w)) >> 12;
  }
  surface.material = mixed(material, look.obstacle, w);
  surface.light = grid.at_surface(p, n);
  surface.arriving = arriving_light(look, surface.light, n, look.glows && w > 0);
  return surface;
}
inline Vec body_of(const Surface& surface) {
  return product(surface.arriving, surface.material.diffuse) >> 12;
}

// Holds what an eye in the direction e sees in the surface as in a mirror. `n` points to the eye's side.
struct Mirrored {
  Int eye = 0, more = 0;
  Vec shine;  // highlight and surroundings
};
inline Mirrored mirrored_in(const Look& look, const Surface& surface, Vec n, Vec e) {
  const Int one = power_of_two(14), facing = cosine(n, look.to_light);
  const Material& material = surface.material;
  const LightBytes& light = surface.light;

  const Vec half = unit_of(look.to_light + e);
  const Int shine = clamped(cosine(n, half), 0, one);
  Int peak = mixed(Look::highlight_of(look.highlights, shine),
                   Look::highlight_of(look.obstacle_highlights, shine), surface.w);
  peak = (((peak * smooth(0, 1024, facing >> 2)) >> 12) * whole(light.lamp)) >> 8;

  Mirrored mirrored;
  mirrored.eye = clamped(cosine(n, e), 0, one);
  const Int a = one - mirrored.eye, a2 = (a * a) >> 14, graze = (((a2 * a2) >> 14) * a) >> 14;
  mirrored.more = (graze * material.gloss) >> 14;
  const Vec r = ((n * ((2 * dot(n, e)) >> 14)) >> 14) - e;
  const Int free = 614 + ((whole(seen(light.open, r)) * whole(seen(light.open, n)) * 3482) >> 16);

  const Vec lamp_seen =
      Vec{9830, 9626, 9216} * smooth(look.lamp_low, look.lamp_high, cosine(r, look.to_light) >> 2);
  const Vec strip_seen = Vec{2867, 3072, 3482} * smooth(look.strip_low, 3973, cosine(r, look.to_strip) >> 2);
  const Vec around = look.surroundings[clamped(r.y + one, 0, power_of_two(15)) >> 4] + (lamp_seen >> 12) +
                     (strip_seen >> 12);
  const Vec fresnel = material.mirror + (((Vec{4096, 4096, 4096} - material.mirror) * mirrored.more) >> 12);
  mirrored.shine = ((material.highlight * peak) >> 12) + (product((around * free) >> 12, fresnel) >> 12);
  return mirrored;
}

inline Vec matter_color(const Look& look, const LightGrid& grid, const MatterBytes& bytes, Vec p, Vec n,
                        Vec e) {
  const Surface surface = surface_at(look, grid, bytes, p, n);
  const Mirrored mirrored = mirrored_in(look, surface, n, e);
  return body_of(surface) + mirrored.shine +
         ((surface.emission * (2540 + ((1556 * mirrored.eye) >> 14))) >> 12);
}
