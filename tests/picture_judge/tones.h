// The tones of solids follow docs/picture/light.md section 1.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <tuple>
#include <vector>

#include "input.h"

struct Tones {
  explicit Tones(const Input& in) {
    if (in.glows || in.materials.empty()) return;
    std::vector<Vec> colors, kept;
    for (const ColorNumbers& c : in.materials)
      colors.push_back({scaled_number(c.red, 12), scaled_number(c.green, 12), scaled_number(c.blue, 12)});
    for (std::size_t i = 1; i < colors.size(); ++i) {
      const auto same = [&](const Vec& c) { return equal(c, colors[i]); };
      if (!same(colors[0]) && std::none_of(kept.begin(), kept.end(), same)) kept.push_back(colors[i]);
    }
    if (kept.empty()) return;
    const auto key = [&](const Vec& c) {
      const Vec f = colors[0];
      return std::make_tuple(2 * std::abs(c.x - f.x) + 7 * std::abs(c.y - f.y) + std::abs(c.z - f.z), c.x,
                             c.y, c.z);
    };
    std::sort(kept.begin(), kept.end(), [&](const Vec& a, const Vec& b) { return key(a) < key(b); });
    tints = {colors[0]};  // c1, c3, ... go to its right, c2, c4, ... to its left
    for (std::size_t i = 0; i < kept.size(); ++i)
      tints.insert(i % 2 == 0 ? tints.end() : tints.begin(), kept[i]);
    for (const Vec& color : colors) {
      Int j = 0;
      while (!equal(tints[j], color)) ++j;
      tone_of.push_back(255 * j / (static_cast<Int>(tints.size()) - 1));
    }
  }
  std::vector<Vec> tints;  // none, if the look has no tones
  Ints tone_of;            // by material

 private:
  static bool equal(const Vec& a, const Vec& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
};
