// Section 5 of docs/automaton.md is written again and plainly: the rays of every kind of source, and the heat
// that a cell receives. Only the data of kernel/automaton/rule are used.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "kernel/engine/visibility/caster.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::visibility {

// Describes a source at one step.
struct Shine {
  rule::SourceKind kind = rule::SourceKind::point;
  rule::SourceKey key;
};

struct PageRay {
  Cell cell;
  int face;  // 0..5
  int number;
  Ray ray;
  std::int64_t weight;
};

namespace page {

__extension__ using Wide = __int128;
using Three = std::array<Wide, 3>;

inline Three three(const rule::Position& p) { return {p.x, p.y, p.z}; }
inline Wide dot(const Three& a, const Three& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Wide floored(Wide over, Wide under) {  // under > 0
  const Wide whole = over / under;
  return whole * under > over ? whole - 1 : whole;
}
inline Wide root(Wide square) {
  auto guess = static_cast<Wide>(std::sqrt(static_cast<long double>(square)));
  while (guess * guess > square) --guess;
  while ((guess + 1) * (guess + 1) <= square) ++guess;
  return guess;
}

// Computes the word of section 2, with another last word of the key.
inline std::uint64_t word(std::uint64_t seed, std::uint32_t face, std::uint64_t index) {
  const auto right = [](std::uint32_t v) { return v >> 8 | v << 24; };
  const auto left = [](std::uint32_t v) { return v << 3 | v >> 29; };
  std::array<std::uint32_t, 10> k{static_cast<std::uint32_t>(seed)};
  std::array<std::uint32_t, 12> l{static_cast<std::uint32_t>(seed >> 32), 0x766F786D, 0x72617973};
  for (std::uint32_t i = 0; i < 9; ++i) {
    l[i + 3] = (k[i] + right(l[i])) ^ i;
    k[i + 1] = left(k[i]) ^ l[i + 3];
  }
  std::uint32_t x = face, y = static_cast<std::uint32_t>(index);
  for (const std::uint32_t key : k) {
    x = (right(x) + y) ^ key;
    y = left(y) ^ x;
  }
  return std::uint64_t{x} << 32 | y;
}

struct Turned {
  Wide rho, p, q;
};
inline Turned turned(std::uint64_t word, int n, int rays) {
  int bits = 0, reversed = 0;
  while (1 << bits < rays) ++bits;
  for (int b = 0; b < bits; ++b) reversed |= (n >> b & 1) << (bits - 1 - b);
  const Wide u = (Wide{word} + 65536 * n / rays) % 65536;
  const Wide v = (Wide{word / 65536} + 65536 * reversed / rays) % 65536;
  const Wide rho = root(2048 * (2 * v + 1));
  static const std::vector<Wide> cosines = [] {
    std::vector<Wide> all;
    all.reserve(64);
    for (int at = 0; at < 64; ++at)
      all.push_back(static_cast<Wide>(std::floor(16384 * std::cos((2 * at + 1) * std::numbers::pi / 256))));
    return all;
  }();
  const auto cosine = [](Wide at) { return cosines.at(static_cast<std::size_t>(at)); };
  const Wide c = u / 256 % 64;
  Wide p = 1 + rho * cosine(c) / 16384, q = 1 + rho * cosine(63 - c) / 16384;
  for (Wide t = 0; t < u / 16384; ++t) {
    const Wide old = p;
    p = -q;
    q = old;
  }
  return {rho, p, q};
}

inline Three lengthened(const Three& v) {
  Three longer{};
  for (std::size_t a = 0; a < 3; ++a) longer[a] = floored((Wide{1} << 20) * v[a], root(4096 * dot(v, v)));
  return longer;
}

inline Three on_disc(const Three& s, const Three& delta, Wide radius, const Turned& place) {
  std::size_t e = 0;
  const auto size = [&](std::size_t a) { return delta[a] < 0 ? -delta[a] : delta[a]; };
  if (size(1) < size(e)) e = 1;
  if (size(2) < size(e)) e = 2;
  Three g{};
  g[(e + 1) % 3] = delta[(e + 2) % 3];
  g[(e + 2) % 3] = -delta[(e + 1) % 3];
  const Three G = lengthened(g), F = lengthened(delta);
  const Three cross{F[1] * G[2] - F[2] * G[1], F[2] * G[0] - F[0] * G[2], F[0] * G[1] - F[1] * G[0]};
  Three end{};
  for (std::size_t a = 0; a < 3; ++a)
    end[a] = s[a] + floored(radius * (place.p * G[a] + place.q * floored(cross[a], 16384)), Wide{1} << 28);
  return end;
}

// Returns the first P + k D outside the grid, with k counted up from 1.
inline Three out_of(const state::Grid& g, const Three& from, const Three& way) {
  const Three n{g.x, g.y, g.z};
  Three at = from;
  const auto left = [&] {
    for (std::size_t b = 0; b < 3; ++b)
      if (at[b] <= 0 || at[b] >= 16 * n[b]) return true;
    return false;
  };
  do {
    for (std::size_t b = 0; b < 3; ++b) at[b] += way[b];
  } while (!left());
  return at;
}

inline bool opaque(const worlds::Volume& v, const Cell& c) {
  return v.grid.contains(c[0], c[1], c[2]) &&
         (v.solid.test(c[0], c[1], c[2]) || v.inert.test(c[0], c[1], c[2]));
}

}  // namespace page

// Adds all rays that are cast from one cell.
inline void add_page_rays(std::vector<PageRay>& rays, const worlds::Volume& v, const Cell& cell,
                          const Shine& shine, int side, std::uint64_t seed) {
  using namespace page;
  using enum rule::SourceKind;
  const state::Grid& g = v.grid;
  const Three middle{16 * cell[0] + 8, 16 * cell[1] + 8, 16 * cell[2] + 8};
  const Three s = three(shine.key.at), sun = three(shine.key.direction);
  const Three delta{s[0] - middle[0], s[1] - middle[1], s[2] - middle[2]};
  const auto index = (static_cast<std::uint64_t>(cell[2]) * static_cast<std::uint64_t>(g.y) +
                      static_cast<std::uint64_t>(cell[1])) *
                         static_cast<std::uint64_t>(g.x) +
                     static_cast<std::uint64_t>(cell[0]);
  for (int f = 0; f < 6; ++f) {
    const auto a = static_cast<std::size_t>(f / 2);
    const int sigma = f % 2 == 0 ? 1 : -1;
    Cell beyond = cell;
    beyond[a] += sigma;
    if (opaque(v, beyond)) continue;
    const bool turns = shine.kind == sphere || shine.kind == sky;
    const std::uint64_t bits = turns ? word(seed, static_cast<std::uint32_t>(f), index) : 0;
    for (int n = 0; n < side * side; ++n) {
      const int i = n / side, j = n % side;
      Three from{};
      from[a] = middle[a] + 8 * sigma;
      from[(a + 1) % 3] = middle[(a + 1) % 3] - 8 + (16 * i + 8) / side;
      from[(a + 2) % 3] = middle[(a + 2) % 3] - 8 + (16 * j + 8) / side;
      const Turned place = turns ? turned(bits, n, side * side) : Turned{};
      Three end{};
      Wide w = 0;
      if (shine.kind == point || shine.kind == sphere) {
        if (dot(delta, delta) == 0) continue;
        end = shine.kind == point ? s : on_disc(s, delta, shine.key.radius, place);
        w = sigma * (end[a] - middle[a]);
        if (w <= 8) continue;
      } else if (shine.kind == directional) {
        w = sigma * sun[a];
        if (w <= 0) continue;
        end = out_of(g, from, sun);
      } else {
        Three way{};
        way[a] = sigma * root((Wide{1} << 28) - place.rho * place.rho);
        way[(a + 1) % 3] = place.p;
        way[(a + 2) % 3] = place.q;
        w = 1;
        if (way[1] <= 0) continue;
        end = out_of(g, from, way);
      }
      const auto narrow = [](const Three& t) {
        return rule::Position{static_cast<std::int64_t>(t[0]), static_cast<std::int64_t>(t[1]),
                              static_cast<std::int64_t>(t[2])};
      };
      rays.push_back({cell, f, n, {beyond, narrow(from), narrow(end)}, static_cast<std::int64_t>(w)});
    }
  }
}

// Returns the rays of all solid cells, by cells in the order of the grid.
inline std::vector<PageRay> page_rays(const worlds::Volume& v, const Shine& shine, int side,
                                      std::uint64_t seed) {
  std::vector<PageRay> rays;
  worlds::for_each(worlds::whole(v.grid), [&](int x, int y, int z) {
    if (v.solid.test(x, y, z)) add_page_rays(rays, v, {x, y, z}, shine, side, seed);
  });
  return rays;
}

// Returns the irradiance of a cell whose seeing rays weigh `sum` together.
inline std::uint64_t page_received(const Cell& cell, const Shine& shine, std::int64_t sum, int rays) {
  using namespace page;
  using enum rule::SourceKind;
  const Wide power = shine.key.power, n = sum;
  if (sum == 0) return 0;
  if (shine.kind == sky) return static_cast<std::uint64_t>(power * n / (256 * rays));
  if (shine.kind == directional) {
    const Three d = three(shine.key.direction);
    return static_cast<std::uint64_t>(64 * power * n / (256 * rays * root(4096 * dot(d, d))));
  }
  const Three s = three(shine.key.at);
  const Three delta{s[0] - 16 * cell[0] - 8, s[1] - 16 * cell[1] - 8, s[2] - 16 * cell[2] - 8};
  const Wide radius = shine.kind == sphere ? shine.key.radius : 0;
  const Wide d2 = std::max({dot(delta, delta), radius * radius, Wide{256}});
  return static_cast<std::uint64_t>(64 * power * n / (rays * d2 * root(4096 * d2)));
}

}  // namespace voxmelt::visibility
