// The look in integers and its tables follow docs/picture/light.md sections 1 and 2.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "clear_look.h"
#include "tones.h"

// Light counts in 4096ths.
inline Int times(Int a, Int b) { return rounded(a * b, 12); }
inline Vec times(Vec a, Int b) { return {times(a.x, b), times(a.y, b), times(a.z, b)}; }
inline Vec times(Vec a, Vec b) { return {times(a.x, b.x), times(a.y, b.y), times(a.z, b.z)}; }
inline Int mixed(Int a, Int b, Int w) { return a + times(b - a, w); }
inline Vec mixed(Vec a, Vec b, Int w) { return {mixed(a.x, b.x, w), mixed(a.y, b.y, w), mixed(a.z, b.z, w)}; }
inline Int smooth(Int low, Int high, Int v) {
  const Int t = clamped(floor_divided(4096 * (v - low), high - low), 0, 4096);
  return (t * t * (12288 - 2 * t)) >> 24;
}

struct Material {
  Vec diffuse, mirror, highlight;
  Int gloss = 0;
};
inline Material mixed(const Material& a, const Material& b, Int w) {
  return {mixed(a.diffuse, b.diffuse, w), mixed(a.mirror, b.mirror, w), mixed(a.highlight, b.highlight, w),
          mixed(a.gloss, b.gloss, w)};
}

inline Vec light_color(const ColorNumbers& c) {
  return {scaled_number(c.red, 12), scaled_number(c.green, 12), scaled_number(c.blue, 12)};
}

class Look {
 public:
  explicit Look(const Input& in) : glows(in.glows), clear(in), tones(in) {
    ground = light_color(in.ground);
    background = light_color(in.background);
    const Int specular = scaled_number(in.specular, 12), metallic = scaled_number(in.metallic, 12);
    const Int ambient = scaled_number(in.ambient, 12);
    const Int shininess = std::max<Int>(scaled_number(in.shininess, 0), 1);
    cold = scaled_number(in.glow_cold, 16);
    hot = scaled_number(in.glow_hot, 16);
    to_light = direction_to_lamp(in.light_x, in.light_y, in.light_z);
    to_strip = unit_of({-to_light.x, 5734, -to_light.z});

    lamp = times(Vec{4342, 4096, 3768}, times(4915, 4096 - ambient));
    from_below = times(times(ground, 3686), ambient);
    from_above = times(Vec{3850, 4096, 4424}, ambient);

    solid = material(light_color(in.solid), times(specular, 2867), glows ? 0 : metallic);
    liquid = glows ? material({0, 0, 0}, times(specular, 492), 0)
                   : material(light_color(in.liquid), specular, metallic);
    obstacle = material(mixed(ground, {4096, 4096, 4096}, 492), 123, 0);

    highlights = highlight_table(shininess);
    obstacle_highlights = highlight_table(12);
    blur = clamped(floor_divided(24576, shininess + 6), 205, 4096);
    for (Int i = 0; i <= 2048; ++i) surroundings.push_back(surroundings_at(4 * (i - 1024)));
    for (Int i = 0; i < 256; ++i) add_glow(i);
    if (!tones.tints.empty())
      for (Int i = 0; i < 256; ++i) add_solid(i, times(specular, 2867), metallic);

    lamp_low = 3523 - times(1229, blur);  // section 6: the mirrored lights
    lamp_high = 3809 + times(287, blur);
    strip_low = 3277 - times(1229, blur);
  }
  // Scales by a power of 2 that brings the largest magnitude to 1/2 or more, and below 1 (section 1).
  static Vec direction_to_lamp(double x, double y, double z) {
    const double largest = std::max({std::abs(x), std::abs(y), std::abs(z)});
    if (!(largest > 0)) throw std::runtime_error("the lamp has no direction");
    int power = 0;
    while (std::ldexp(largest, power) >= 1) --power;
    while (std::ldexp(largest, power) < 0.5) ++power;
    return unit_of({scaled_number(std::ldexp(x, power), 24), scaled_number(std::ldexp(y, power), 24),
                    scaled_number(std::ldexp(z, power), 24)});
  }
  // Reads a table for a cosine from 0 to 2^14 (section 2).
  static Int highlight_of(const Ints& table, Int c) {
    const Int i = c >> 4;
    return table[i] + (((table[i + 1] - table[i]) * (c & 15)) >> 4);
  }

  // Returns what the solid is made of, by the byte of heat.
  const Material& solid_of(Int heat) const { return solids.empty() ? solid : solids[heat]; }

  bool glows;
  ClearLook clear;
  Tones tones;
  Vec ground, background, to_light, to_strip, lamp, from_below, from_above;
  Int cold = 0, hot = 0, blur = 0, lamp_low = 0, lamp_high = 0, strip_low = 0;
  Material solid, liquid, obstacle;
  Ints highlights, obstacle_highlights;
  std::vector<Vec> surroundings, glow_light, glow_crust;
  std::vector<Material> solids;  // by tone

 private:
  Material material(Vec color, Int specular, Int metallic) const {
    const Int d = times(specular, 328);
    Material m;
    m.diffuse = times(color, 4096 - times(metallic, 3482));
    m.mirror = mixed(Vec{d, d, d}, color, metallic);
    m.highlight = times(times(mixed(Vec{4096, 4096, 4096}, color, metallic), lamp), specular);
    m.gloss = times(mixed(times(specular, 4915), 4096, metallic), 2867);
    return m;
  }
  static Int power(Int x, Int e) {
    Int result = power_of_two(15);
    for (Int bit = bits(e) - 1; bit >= 0; --bit) {
      result = rounded(result * result, 15);
      if ((e >> bit) & 1) result = rounded(result * x, 15);
    }
    return result;
  }
  static Ints highlight_table(Int shininess) {
    Ints table;
    for (Int i = 0; i <= 1024; ++i) table.push_back(power(32 * i, shininess) >> 3);
    table.push_back(table.back());
    return table;
  }
  Vec surroundings_at(Int h) const {
    const Vec sky = mixed(Vec{3768, 3850, 3973}, Vec{901, 1065, 1352},
                          smooth(-times(819, blur), 3072 + times(1229, blur), h));
    const Vec below = mixed(times(ground, 3072), times(ground, 1024), smooth(0, 2867, -h));
    const Int edge = times(1229, blur);
    const Vec seen = mixed(below, sky, smooth(-246 - edge, 246 + edge, h));
    const auto kept = [](Int c, Int m) { return clamped((c * m + 2048) >> 12, 0, m); };
    return {2 * kept(seen.x, 2047), 2 * kept(seen.y, 2047), 4 * kept(seen.z, 1023)};
  }
  void add_solid(Int i, Int specular, Int metallic) {
    const Int n = static_cast<Int>(tones.tints.size());
    const auto tone_of = [n](Int j) { return 255 * j / (n - 1); };
    Int j = n - 2;
    while (tone_of(j) > i) --j;
    const Int share = smooth(512, 3584, 4096 * (i - tone_of(j)) / (tone_of(j + 1) - tone_of(j)));
    solids.push_back(material(mixed(tones.tints[j], tones.tints[j + 1], share), specular, metallic));
  }
  void add_glow(Int i) {
    const auto p = [](Int a, Int b) { return rounded(a * b, 16); };
    const Int h = floor_divided(65536 * i + 127, 255);
    const Int s = floor_root(h * 65536), f = floor_root(s * 65536);
    const Int h2 = p(h, h), h4 = p(h2, h2), h8 = p(h4, h4);
    glow_light.push_back({p(p(p(h, s), f), 9421), p(p(h4, s), 4710), p(h8, 819)});
    glow_crust.push_back(mixed(Vec{139, 119, 115}, Vec{164, 57, 33}, h >> 4));
  }
};
