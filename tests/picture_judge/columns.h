// Columns, their beds and their puddles follow docs/picture/field.md sections 2 to 4.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "input.h"

const Int ONE = 4096;

struct Column {
  Int bed = 0, top = 0, offset = 0, film = 0, stands = 0, wet = 0, floor = 0, end = 0;
  Int distance = 0;  // capped at 3: the page asks for 0, 1, 2 only
  bool filled = false;
  Int rise = 0;
  bool puddle = false;
  Int depth = 0, level = 0, shift = 0;
};

// Reads the state as section 2 does. Above the grid there is air.
struct State {
  const Input& in;
  Int mask(Int x, Int y, Int z) const { return y >= in.ny ? 0 : in.mask[in.cell(x, y, z)]; }
  bool solid(Int x, Int y, Int z) const { return (mask(x, y, z) & 1) != 0; }
  bool liquid(Int x, Int y, Int z) const { return (mask(x, y, z) & 2) != 0; }
  bool inert(Int x, Int y, Int z) const { return (mask(x, y, z) & 4) != 0; }
  // Returns a of section 2.
  Int matter(Int x, Int y, Int z) const {
    return solid(x, y, z) || liquid(x, y, z) ? std::min(in.amount[in.cell(x, y, z)], ONE) : 0;
  }
};

// Computes section 3, but for the numbers that need other columns.
inline Column column_of(const State& state, Int x, Int z) {
  const Input& in = state.in;
  Column c;
  while (c.bed < in.ny && state.inert(x, c.bed, z)) ++c.bed;
  if (in.has_terrain) {
    const Int t = std::max<Int>(scaled_number(in.terrain[in.column(x, z)], 0), 0);
    c.bed = std::min(c.bed, t);
  }
  c.top = c.bed;
  for (Int y = c.bed; y < in.ny; ++y)
    if (state.inert(x, y, z)) c.top = y + 1;
  if (c.bed > 0) {
    c.offset = clamped(in.amount[in.cell(x, c.bed - 1, z)] - 2048, -2048, 2048);
    c.film = std::min<Int>(state.matter(x, c.bed, z), 614) * ONE / 614;
  }
  c.stands = state.inert(x, c.bed, z) ? 1 : 0;
  if (c.bed > 0) c.wet = c.stands ? ONE : c.film;
  c.floor = state.liquid(x, c.bed, z) ? c.bed : c.top;
  c.end = c.floor;
  while (state.liquid(x, c.end, z)) ++c.end;
  return c;
}

// Computes filled, sink and rise (section 3).
inline void fill_grounds(const Input& in, std::vector<Column>& columns) {
  for (Int z = 0; z < in.nz; ++z)
    for (Int x = 0; x < in.nx; ++x) {
      Column& c = columns[in.column(x, z)];
      c.distance = 3;
      for (Int dz = -2; dz <= 2; ++dz)
        for (Int dx = -2; dx <= 2; ++dx) {
          if (x + dx < 0 || x + dx >= in.nx || z + dz < 0 || z + dz >= in.nz) continue;
          if (columns[in.column(x + dx, z + dz)].wet > 0)
            c.distance = std::min(c.distance, std::max(magnitude(dx), magnitude(dz)));
        }
      c.filled = c.bed > 0 && c.distance <= 2;
      const Int sink = c.distance <= 1 ? 1638 - 1638 * c.wet / ONE : 4096;
      c.rise = c.offset - sink;
      if (c.stands) c.rise = std::max<Int>(c.rise, 0);
    }
}

// Section 4 defines this share.
inline Int share_of_bend(Int d) { return clamped(8192 - (magnitude(d) >> 4), 0, 4096); }

inline void level_puddles(const State& state, std::vector<Column>& columns) {
  const Input& in = state.in;
  Ints level(columns.size(), 0);
  for (Int z = 0; z < in.nz; ++z)
    for (Int x = 0; x < in.nx; ++x) {
      Column& c = columns[in.column(x, z)];
      for (Int y = c.floor; y < c.end; ++y) c.depth += state.matter(x, y, z);
      c.puddle = in.smooth > 0 && c.floor > 0 && c.depth > 0 && c.end < in.ny && !state.inert(x, c.end, z) &&
                 state.matter(x, c.end, z) == 0;
      c.level = c.floor * ONE + c.depth + (c.floor == c.bed ? c.offset : 0);
      level[in.column(x, z)] = 16 * c.level;
    }
  const auto has_puddle = [&](Int x, Int z) {
    return x >= 0 && x < in.nx && z >= 0 && z < in.nz && columns[in.column(x, z)].puddle;
  };
  for (Int pass = 0; pass < std::min<Int>(4 * in.smooth, 12); ++pass) {
    const Ints before = level;
    for (Int z = 0; z < in.nz; ++z)
      for (Int x = 0; x < in.nx; ++x) {
        if (!has_puddle(x, z)) continue;
        const Int here = before[in.column(x, z)];
        const auto bend = [&](Int dx, Int dz) -> Int {
          if (!has_puddle(x + dx, z + dz) || !has_puddle(x - dx, z - dz)) return 0;
          const Int b = before[in.column(x + dx, z + dz)] - here;
          const Int c = before[in.column(x - dx, z - dz)] - here;
          return ((b + c) * std::min(share_of_bend(b), share_of_bend(c))) >> 12;
        };
        const Int straight = bend(1, 0) + bend(0, 1);
        const Int diagonal = bend(1, 1) + bend(1, -1);
        level[in.column(x, z)] = here + ((2 * straight + diagonal) >> 4);
      }
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    Column& c = columns[i];
    const Int most = std::min<Int>(1024, c.depth >> 1);
    if (c.puddle) c.shift = clamped((level[i] >> 4) - c.level, -most, most);
  }
}

inline std::vector<Column> make_columns(const Input& in) {
  const State state{in};
  std::vector<Column> columns;
  for (Int z = 0; z < in.nz; ++z)
    for (Int x = 0; x < in.nx; ++x) columns.push_back(column_of(state, x, z));
  fill_grounds(in, columns);
  level_puddles(state, columns);
  return columns;
}
