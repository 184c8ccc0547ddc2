// Noise, the texture of rock and the ground's colour follow docs/picture/ground.md sections 6 to 8.
#pragma once

#include <algorithm>
#include <cstdint>

#include "ground.h"

// Section 6 defines these functions.
inline Int smooth256(Int t) { return (t * t * (768 - 2 * t)) >> 16; }
inline Int smooth_step(Int l, Int u, Int v) {
  return smooth256(floor_divided((clamped(v, l, u) - l) * 256, u - l));
}

inline Int lattice(Int x, Int y, Int z, Int kind) {
  const auto word = [](Int v) { return static_cast<std::uint32_t>(v); };  // mod 2^32
  std::uint32_t h =
      word(x) * 0x8DA6B343u ^ word(y) * 0xD8163841u ^ word(z) * 0xCB1AB31Fu ^ word(kind) * 0x9E3779B1u;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  h = h ^ (h >> 15);
  return static_cast<Int>(h >> 19) - 4096;
}
inline Int noise(Vec p, Int kind) {
  const Vec c = p >> 20;
  const auto weight = [](Int v) { return smooth256((v >> 12) & 255); };
  const auto row = [&](Int y, Int z) {
    return blended(lattice(c.x, y, z, kind), lattice(c.x + 1, y, z, kind), weight(p.x));
  };
  const auto plane = [&](Int z) { return blended(row(c.y, z), row(c.y + 1, z), weight(p.y)); };
  return blended(plane(c.z), plane(c.z + 1), weight(p.z));
}
inline Int layers_of_noise(Vec position, Int spacing, Int octaves, Int kind) {
  Vec p = position >> spacing;
  Int sum = 0;
  for (Int i = 0; i < octaves; ++i) {
    sum += noise(p, kind + i) >> i;
    p = Vec{p.z, p.x, p.y} * 2 + (Vec{17, 91, 501} << 16);
  }
  return (9 * sum) >> 4;
}
inline Int patches(Vec p) { return layers_of_noise(p, 4, 3, 0); }
inline Int grain(Vec p) { return layers_of_noise(p, 1, 3, 16); }
inline Int relief(Vec p) { return layers_of_noise(p, 1, 4, 32); }
inline Int band_noise(Vec p) { return layers_of_noise(p, 1, 3, 48); }

struct GroundLook {
  Vec color, normal;
};

// The rock follows sections 7 and 8.
class Rock {
 public:
  Rock(const Input& in, const Ground& the_ground, Vec base_color)
      : ground(the_ground),
        base(base_color),
        textured(in.has_terrain && in.textured && the_ground.exists),
        ny(in.ny) {
    if (!textured) return;
    const Int longer = std::max(in.nx, in.nz);
    q = longer <= 128 ? 2 : longer <= 256 ? 1 : 0;
    across = in.nx << q;
    deep = in.nz << q;
    for (Int k = 0; k < deep; ++k)
      for (Int i = 0; i < across; ++i) add_texel(i, k);
    for (Int i = 0; i < 4 * ny; ++i) bands.push_back(band_noise({0, (2 * i + 1) << 17, 0}));
    const auto bend = [](Vec p) { return 192 * noise(p >> 4, 64); };
    for (Int k = 0; k < in.nz; ++k) {
      bends[0].push_back(bend({0, 0, (2 * k + 1) << 19}));
      bends[1].push_back(bend({in.nx << 20, 0, (2 * k + 1) << 19}));
    }
    for (Int i = 0; i < in.nx; ++i) {
      bends[2].push_back(bend({(2 * i + 1) << 19, 0, 0}));
      bends[3].push_back(bend({(2 * i + 1) << 19, 0, in.nz << 20}));
    }
  }
  // Returns the colour, and the normal with the bumps (section 8).
  GroundLook look_of(const GroundHit& hit) const {
    const Vec normal = ground_normal(ground, hit);
    if (hit.face != Face::top) return {cut_color(hit), normal};
    if (!textured) return {base, normal};
    const auto read = [&](const Ints& texels, Int factor) {
      const CellWeight x = cell_weight(hit.crossing.x << q), z = cell_weight(hit.crossing.z << q);
      const auto at = [&](Int i, Int k) {
        return factor * texels[clamped(k, 0, deep - 1) * across + clamped(i, 0, across - 1)];
      };
      return blended(blended(at(x.cell, z.cell), at(x.cell + 1, z.cell), x.weight),
                     blended(at(x.cell, z.cell + 1), at(x.cell + 1, z.cell + 1), x.weight), z.weight);
    };
    const Vec bump{read(bump_x, 64), 0, read(bump_z, 64)};
    return {{read(red, 1), read(green, 1), read(blue, 1)}, unit_of(normal + bump)};
  }

 private:
  Vec place_of(Int i, Int k) const {
    const Int x = (2 * i + 1) * power_of_two(19 - q), z = (2 * k + 1) * power_of_two(19 - q);
    return {x, 256 * ground.bare_height(x, z), z};
  }
  void add_texel(Int i, Int k) {
    const Vec place = place_of(i, k);
    const Int H = ground.bare_height(place.x, place.z);
    const Int p = patches(place), g = grain(place);
    const Vec n = ground.top_normal(place.x, place.z);
    const Int e = floor_divided((H - ground.lowest) * 4096, std::max<Int>(1, ground.highest - ground.lowest));
    const Int pale = smooth_step(410, 3686, e + ((51 * p) >> 8));
    const Int steep = (3 * smooth_step(492, 2048, 4096 - (n.y >> 2) + ((15 * p) >> 8))) >> 2;
    const Int shade = 4096 + ((36 * p + 31 * g) >> 8);
    const auto mixed = [](Int a, Int b, Int w) { return a + (((b - a) * w + 128) >> 8); };
    const auto texel = [&](Int base_channel, Int low, Int high, Int cliff) {
      const Int tint = mixed(mixed(low, high, pale), cliff, steep);
      return (((base_channel * tint) >> 8) * shade) >> 12;
    };
    red.push_back(texel(base.x, 236, 287, 159));
    green.push_back(texel(base.y, 251, 261, 154));
    blue.push_back(texel(base.z, 220, 241, 154));
    const auto bump = [&](Vec before, Vec behind) {
      return clamped(((relief(before) - relief(behind)) * 225) >> (15 - q), -128, 127);
    };
    bump_x.push_back(bump(place_of(i - 1, k), place_of(i + 1, k)));
    bump_z.push_back(bump(place_of(i, k - 1), place_of(i, k + 1)));
  }
  static Int linear(const Ints& table, Int position) {
    const CellWeight c = cell_weight(position);
    const Int last = static_cast<Int>(table.size()) - 1;
    return blended(table[clamped(c.cell, 0, last)], table[clamped(c.cell + 1, 0, last)], c.weight);
  }
  Vec cut_color(const GroundHit& hit) const {
    Int band = 0;
    const int side = static_cast<int>(hit.face);  // low x, high x, low z, high z are 0 to 3
    if (textured && side < 4) {
      const Int along = side < 2 ? hit.crossing.z : hit.crossing.x;
      band = linear(bands, 4 * (hit.crossing.y + linear(bends[side], along)));
    }
    const Int factor = 2540 + ((41 * band) >> 8);
    return (base * factor) >> 12;
  }
  const Ground& ground;
  Vec base;
  bool textured;
  Int ny, q = 0, across = 0, deep = 0;
  Ints red, green, blue, bump_x, bump_z, bands, bends[4];
};
