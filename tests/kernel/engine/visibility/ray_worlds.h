// These volumes are hard for rays, these sources lie in awkward places, and the page asks for every one of
// the rays.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/kernel/engine/visibility/by_the_page.h"

namespace voxmelt::visibility {

using namespace worlds;
using rule::Position;

// A cell at the middle distance of the grid feels this power, and it cuts the nearest.
constexpr std::uint64_t kRayPower = std::uint64_t{1} << 24;

inline rule::Heat shone_by(const std::vector<Position>& sources, int rays = 1,
                           std::uint64_t power = kRayPower) {
  rule::Heat heat;
  heat.enabled = heat.radiation = true;
  heat.rays_per_face = rays;
  for (const Position& at : sources) heat.sources.push_back({{{0, at, power}}});
  return heat;
}

// Returns sides that straddle words of 64 and bricks of 8, or are a single cell. The grid has at most 2^14
// cells.
inline Grid hostile_grid(Random& random) {
  const auto side = [&] { return random.any({1, 2, 7, 8, 9, 15, 16, 17, 25, 63, 64, 65, 72, 130}); };
  Grid g{side(), side(), side()};
  while (g.cells() > 1u << 14) {
    int& longest = g.x >= g.y && g.x >= g.z ? g.x : g.y >= g.z ? g.y : g.z;
    longest = std::max(1, longest / 2 + random.between(-1, 1));
  }
  return g;
}

inline void put_any(Volume& v, Random& random, int x, int y, int z) {
  if (random.one_in(4)) return put_inert(v, x, y, z);
  if (random.one_in(6)) return put(v, x, y, z, 4096);
  put_solid(v, x, y, z);
}

// Makes dust, blocks of cells, plates, or all but some holes.
inline Volume hostile_world(Random& random, const Grid& g) {
  Volume v(g);
  const int kind = random.below(4);
  const std::int32_t sparse = random.between(2, 40);
  if (kind == 0 || kind == 3)
    for_each(whole(g), [&](int x, int y, int z) {
      if (random.one_in(sparse) != (kind == 3)) put_any(v, random, x, y, z);
    });
  for (int n = kind == 1 || kind == 2 ? random.between(1, 6) : 0; n > 0; --n) {
    Box box{random.below(g.x), random.below(g.y), random.below(g.z), 0, 0, 0};
    const auto end = [&](int begin, int size) {
      return kind == 2 && random.one_in(3) ? begin + 1 : random.between(begin + 1, size);
    };
    box.x1 = end(box.x0, g.x);
    box.y1 = end(box.y0, g.y);
    box.z1 = end(box.z0, g.z);
    for_each(box, [&](int x, int y, int z) {
      if (!random.one_in(50)) put_any(v, random, x, y, z);
    });
  }
  return v;
}

// Puts a source in the plane of faces, on an edge or a corner, at the centre of a cell (also of a solid),
// anywhere, or far outside. Far sources need more than 64 bits for one denominator.
inline Position awkward_source(Random& random, const Grid& g) {
  const bool far = random.one_in(6);
  const auto coordinate = [&](int size) -> std::int64_t {
    switch (random.below(far ? 6 : 4)) {
      case 0:
        return 16 * random.between(-1, size + 1);
      case 1:
        return 16 * random.below(size) + 8;
      case 2:
        return random.between(-100, 16 * size + 100);
      case 3:
        return random.between(0, 16 * size);
      case 4:
        return random.between(-(1 << 25), 1 << 25);
      default:
        return random.between(-40000, 40000);
    }
  };
  return {coordinate(g.x), coordinate(g.y), coordinate(g.z)};
}

// Makes a sphere from nothing to larger than its distance, a sun along axes and nearly along them, or a sky.
inline Shine awkward_shine(Random& random, const Grid& g, rule::SourceKind kind) {
  const rule::SourceKindRow& row = rule::row_of(kind);
  Shine shine{kind, {.power = kRayPower}};
  if (row.at) shine.key.at = awkward_source(random, g);
  if (row.radius) shine.key.radius = random.any({0, 1, 7, 30, 100, 400, 3000, 1 << 17, 1 << 24});
  if (row.direction) {
    const auto part = [&]() -> std::int64_t {
      const std::int32_t most = random.any({0, 1, 5, 40, 1000, 32768, 65536});
      return random.one_in(3) ? most : random.between(-most, most);
    };
    shine.key.direction = {part(), part(), part()};
  }
  return shine;
}
inline Shine awkward_shine(Random& random, const Grid& g) {
  const auto kinds = static_cast<std::int32_t>(rule::kSourceKinds.size());
  return awkward_shine(random, g, rule::kSourceKinds.at(static_cast<std::size_t>(random.below(kinds))).kind);
}

inline rule::Heat shone_by(const std::vector<Shine>& shines, int rays, std::uint64_t seed) {
  rule::Heat heat;
  heat.enabled = heat.radiation = true;
  heat.rays_per_face = rays;
  heat.ray_seed = seed;
  for (const Shine& shine : shines) heat.sources.push_back({{shine.key}, shine.kind});
  return heat;
}

}  // namespace voxmelt::visibility
