// Rays begin and end at places computed here (docs/automaton.md, section 5): faces of a cell, places on a
// disc, and the way out of the grid.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/rule/random.h"
#include "kernel/automaton/rule/visibility.h"

namespace voxmelt::rule {

using Triple = std::array<std::int64_t, 3>;
VOXMELT_RULE Triple triple(const Position& p) { return {p.x, p.y, p.z}; }
VOXMELT_RULE Position position(const Triple& t) { return {t[0], t[1], t[2]}; }
VOXMELT_RULE std::uint64_t squared(const Triple& t) { return t[0] * t[0] + t[1] * t[1] + t[2] * t[2]; }

// Faces are numbered +x, -x, +y, -y, +z, -z.
inline constexpr int kFaces = 6;
struct Face {
  std::size_t axis;
  std::int64_t side;  // 1 or -1
};
VOXMELT_RULE Face face_of(std::size_t number) { return {number / 2, number % 2 == 0 ? 1 : -1}; }

// Holds floor(16384 cos((2c + 1) pi / 256)).
inline constexpr std::array<std::int64_t, 64> kCosine{
    16382, 16372, 16353, 16323, 16284, 16234, 16175, 16107, 16028, 15940, 15842, 15735, 15618,
    15492, 15357, 15212, 15058, 14895, 14723, 14543, 14353, 14155, 13948, 13733, 13510, 13278,
    13038, 12791, 12536, 12273, 12003, 11726, 11442, 11150, 10853, 10548, 10237, 9920,  9597,
    9268,  8934,  8594,  8249,  7900,  7545,  7186,  6822,  6455,  6083,  5708,  5329,  4948,
    4563,  4175,  3785,  3393,  2998,  2602,  2204,  1805,  1405,  1004,  603,   201};

// Is a place on a disc of radius 16384: its distance rho from the middle, and its coordinates p and q.
struct DiscPlace {
  std::int64_t rho, p, q;
};

// Spreads the places of the rays of a face evenly, and turns them by the face's random word.
VOXMELT_RULE DiscPlace disc_place(std::uint64_t word, int ray, int rays) {
  const std::uint64_t n = ray;
  const std::uint64_t reversed = rays == 16  ? (n & 1) << 3 | (n & 2) << 1 | (n & 4) >> 1 | (n & 8) >> 3
                                 : rays == 4 ? (n & 1) << 1 | (n & 2) >> 1
                                             : n;
  const std::uint64_t count = rays, each = 65536 / count;
  const std::uint64_t u = (word + each * n) & 0xFFFF, v = ((word >> 16) + each * reversed) & 0xFFFF;
  const std::int64_t rho = square_root((2 * v + 1) << 11);
  const std::size_t c = u >> 8 & 63;
  const std::int64_t p = 1 + ((rho * kCosine[c]) >> 14), q = 1 + ((rho * kCosine[63 - c]) >> 14);
  switch (u >> 14) {
    case 0:
      return {rho, p, q};
    case 1:
      return {rho, -q, p};
    case 2:
      return {rho, -p, -q};
    default:
      return {rho, q, -p};
  }
}

// Holds two vectors of length 16384 at right angles to each other and to `delta`, which is not 0.
struct DiscAxes {
  Triple g{}, v{};
};
VOXMELT_RULE Triple lengthened(const Triple& t) {
  const std::int64_t length = square_root(squared(t) << 12);
  Triple result{};
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int64_t over = t[a] * (std::int64_t{1} << 20);
    result[a] = over / length - (over % length < 0 ? 1 : 0);
  }
  return result;
}
VOXMELT_RULE DiscAxes disc_axes(const Triple& delta) {
  const auto size = [&](std::size_t a) { return delta[a] < 0 ? -delta[a] : delta[a]; };
  std::size_t least = 0;
  for (std::size_t a = 1; a < 3; ++a)
    if (size(a) < size(least)) least = a;
  const std::size_t next = (least + 1) % 3, last = (least + 2) % 3;
  Triple across{};
  across[next] = delta[last];
  across[last] = -delta[next];
  DiscAxes axes{lengthened(across), {}};
  const Triple towards = lengthened(delta);
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    axes.v[a] = (towards[b] * axes.g[c] - towards[c] * axes.g[b]) >> 14;
  }
  return axes;
}

// Returns the first of start + way, start + 2 way, ... that has left the grid. `way` leads out of the grid,
// or along its border if `start` lies on the border.
VOXMELT_RULE Position leaving(const Triple& start, const Triple& way, const std::array<int, 3>& grid) {
  std::int64_t k = INT64_MAX;
  for (std::size_t a = 0; a < 3; ++a) {
    if (way[a] == 0) continue;
    const std::int64_t room = way[a] > 0 ? kPositionUnit * grid[a] - start[a] : start[a];
    const std::int64_t each = way[a] > 0 ? way[a] : -way[a];
    k = std::min(k, std::max<std::int64_t>(1, (room + each - 1) / each));
  }
  return {start[0] + k * way[0], start[1] + k * way[1], start[2] + k * way[2]};
}

// Holds what the rays of all cells have in common.
struct RaySetting {
  std::array<int, 3> grid{};
  int side = 1;  // a face has side x side rays
  RoundKeys keys{};

  constexpr int rays() const { return side * side; }
};
constexpr RaySetting ray_setting(const std::array<int, 3>& grid, const Heat& heat) {
  return {grid,
          heat.rays_per_face == 16  ? 4
          : heat.rays_per_face == 4 ? 2
                                    : 1,
          round_keys(heat.ray_seed, kRayWord)};
}

}  // namespace voxmelt::rule
