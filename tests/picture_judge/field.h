// The filtered channels follow docs/picture/field.md sections 2 and 5 to 7.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "columns.h"
#include "tones.h"

struct Field {
  Ints intensity, solid, liquid, heat, obstacle;  // one number for each cell, filtered
};

inline Int intensity_of(Int a) { return 16 * a - ((a + 15) >> 4); }

// Moves a puddle (section 5).
inline void move_puddle(const State& state, const Column& c, Int x, Int z, Int argument, Ints& intensity) {
  const Input& in = state.in;
  const Int s = clamped(argument, -ONE, ONE), p = magnitude(s);
  const auto content = [&](Int y) -> Int {
    if (y < c.floor) return ONE;
    return y < c.end ? state.matter(x, y, z) : 0;
  };
  for (Int y = s < 0 ? c.floor - 1 : c.floor; y <= c.end; ++y) {
    if (y < 0 || y >= in.ny) continue;
    Int& here = intensity[in.cell(x, y, z)];
    if (y == c.end && here != 0) continue;
    const Int neighbour = s < 0 ? content(y + 1) : content(y - 1);
    here = intensity_of((content(y) * (ONE - p) + neighbour * p) >> 12);
  }
}

// Filters in n passes (section 6). A cell outside has the value of the nearest cell inside before the first
// pass and is filtered like any other. So there are n cells more on every side. The outermost of those go
// wrong by one cell a pass and never reach the grid.
inline Ints filtered(const Input& in, const Ints& channel, Int passes) {
  const Int n[3] = {in.nx + 2 * passes, in.ny + 2 * passes, in.nz + 2 * passes};
  const auto place = [&n](Int x, Int y, Int z) { return (z * n[1] + y) * n[0] + x; };
  Ints wide(n[0] * n[1] * n[2]);
  for (Int z = 0; z < n[2]; ++z)
    for (Int y = 0; y < n[1]; ++y)
      for (Int x = 0; x < n[0]; ++x)
        wide[place(x, y, z)] =
            channel[in.cell(clamped(x - passes, 0, in.nx - 1), clamped(y - passes, 0, in.ny - 1),
                            clamped(z - passes, 0, in.nz - 1))];
  for (Int pass = 0; pass < passes; ++pass)
    for (int axis = 2; axis >= 0; --axis) {
      const Ints before = wide;
      for (Int z = 0; z < n[2]; ++z)
        for (Int y = 0; y < n[1]; ++y)
          for (Int x = 0; x < n[0]; ++x) {
            Vec low{x, y, z}, high{x, y, z};
            low.at(axis) = std::max<Int>(low.at(axis) - 1, 0);
            high.at(axis) = std::min(high.at(axis) + 1, n[axis] - 1);
            wide[place(x, y, z)] = (before[place(low.x, low.y, low.z)] + 2 * before[place(x, y, z)] +
                                    before[place(high.x, high.y, high.z)] + 2) >>
                                   2;
          }
    }
  Ints result(channel.size());
  for (Int z = 0; z < in.nz; ++z)
    for (Int y = 0; y < in.ny; ++y)
      for (Int x = 0; x < in.nx; ++x)
        result[in.cell(x, y, z)] = wide[place(x + passes, y + passes, z + passes)];
  return result;
}

// Section 7 defines the mixed intensity.
inline Int mixed_intensity(Int F, Int G, Int s, Int l, Int o) {
  const Int all = (s + l + o + 3) >> 2, soft = (l + 3) >> 2;
  const Int over = clamped(5 * soft - 2 * all, 0, 2 * all);
  const Int t = all == 0 ? 0 : 64 * over / all;
  const Int weight = (t * t * (384 - 2 * t)) >> 13;
  return (G * (256 - weight) + F * weight + 128) >> 8;
}

inline Field make_field(const Input& in, const std::vector<Column>& columns) {
  const State state{in};
  const Tones tones(in);
  Field raw;
  for (Ints* channel : {&raw.intensity, &raw.solid, &raw.liquid, &raw.heat, &raw.obstacle})
    channel->assign(in.mask.size(), 0);
  for (Int z = 0; z < in.nz; ++z)
    for (Int x = 0; x < in.nx; ++x) {
      const Column& c = columns[in.column(x, z)];
      for (Int y = 0; y < in.ny; ++y) {
        const Int i = in.cell(x, y, z);
        const Int matter = intensity_of(state.matter(x, y, z));
        if (state.solid(x, y, z)) raw.solid[i] = matter;
        if (state.liquid(x, y, z)) raw.liquid[i] = matter;
        if (in.glows) raw.heat[i] = (raw.liquid[i] * in.heat[i]) >> 16;
        if (!tones.tints.empty()) raw.heat[i] = (raw.solid[i] * tones.tone_of[in.material[i]] + 255) >> 8;
        if (state.inert(x, y, z) && y >= c.bed) raw.obstacle[i] = 65280;
        raw.intensity[i] = raw.obstacle[i] != 0 ? 65280 : raw.solid[i] + raw.liquid[i];
      }
      if (c.floor > c.bed && c.end > c.floor && c.shift != 0)
        move_puddle(state, c, x, z, c.shift, raw.intensity);
      if (c.filled) {
        for (Int y = 0; y <= std::min(c.bed, in.ny - 1); ++y) {
          Int& here = raw.intensity[in.cell(x, y, z)];
          here = std::max(here, intensity_of(clamped((c.bed - y) * ONE + c.rise, 0, ONE)));
        }
        if (c.floor == c.bed && c.end > c.floor) move_puddle(state, c, x, z, c.rise + c.shift, raw.intensity);
      }
    }
  const Int passes = std::max<Int>({in.smooth, in.smooth_solid, 1});
  Field field;
  field.solid = filtered(in, raw.solid, passes);
  field.liquid = filtered(in, raw.liquid, passes);
  field.heat = filtered(in, raw.heat, passes);
  field.obstacle = filtered(in, raw.obstacle, passes);
  const Ints F = filtered(in, raw.intensity, in.smooth);
  const Ints G = filtered(in, raw.intensity, in.smooth_solid);
  for (std::size_t i = 0; i < F.size(); ++i)
    field.intensity.push_back(
        mixed_intensity(F[i], G[i], field.solid[i], field.liquid[i], field.obstacle[i]));
  return field;
}
