// These states and parameters are allowed in a scene, though no one would write them: every bound at once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "tests/kernel/worlds.h"

namespace voxmelt::worlds {

inline std::int32_t hostile_amount(Random& random) {
  return random.one_in(2)
             ? random.any({1, 7, 8, 31, 32, 33, 2047, 2048, 4095, 4096, 4097, 45055, 45056, 65534, 65535})
             : random.between(1, random.one_in(2) ? 5000 : 65535);
}
inline std::int32_t hostile_heat(Random& random, const Parameters& p) {
  const std::int32_t tm = p.material.melting_point, liquid = tm + p.material.latent_heat;
  return random.one_in(3)
             ? random.below(65536)
             : random.any({0, 1, std::max(0, tm - 1), tm, std::max(0, liquid - 1), liquid, 65534, 65535});
}

inline void hostile_heat_parameters(Random& random, Grid g, Parameters& p) {
  p.heat.enabled = !random.one_in(5);
  p.heat.neighbours = random.any({6, 18, 26});
  const bool bound = !random.one_in(3);
  p.heat.weight_face = static_cast<std::uint16_t>(bound ? 10922 : random.below(10923));
  p.heat.weight_edge = static_cast<std::uint16_t>(bound ? 5461 : random.below(5462));
  p.heat.weight_corner = static_cast<std::uint16_t>(bound ? 3640 : random.below(3641));
  p.heat.walls = p.heat.enabled && random.one_in(3);
  p.heat.convection = static_cast<std::uint16_t>(random.any({0, 1, 20000, 32767}));
  p.heat.air = random.one_in(2);
  p.heat.air_exchange = static_cast<std::uint16_t>(random.any({1, 9000, 43690}));
  for (int y = 0; y < g.y; ++y)
    p.heat.air_temperature.push_back(
        static_cast<rule::Temperature>(random.any({0, 65535, random.below(65536)})));
  p.material.melting_point = static_cast<rule::Temperature>(random.any({0, 1, 30000, 65535}));
  if (random.one_in(2))
    p.material.latent_heat = static_cast<rule::Temperature>(random.below(65536 - p.material.melting_point));
  p.heat.radiation = random.one_in(2);
  p.heat.visibility_every = static_cast<std::uint32_t>(random.between(1, 3));
  rule::HeatSource source;
  for (const std::uint32_t step : {0u, 2u, 5u})
    source.keys.push_back({step,
                           {random.between(-20, 16 * g.x + 20), random.between(-20, 16 * g.y + 20),
                            random.between(-20, 16 * g.z + 20)},
                           std::uint64_t{1} << random.between(0, 49)});
  p.heat.sources.assign(2, source);
}

// Lets a scene freeze and glow, which hostile parameters alone do not. Half of them stay as they are.
inline void may_freeze(Random& random, Parameters& p) {
  if (random.one_in(2)) return;
  const std::int32_t tm = p.material.melting_point;
  p.material.freezing_point =
      static_cast<rule::Temperature>(random.any({tm, tm, std::max(0, tm - 300), random.below(tm + 1)}));
  p.heat.air_glow = static_cast<std::uint16_t>(random.any({0, 1, 700, 10922}));
  p.heat.air_sky = static_cast<rule::Temperature>(random.any({0, 65535, random.below(65536)}));
  if (p.heat.air_glow > 0 && random.one_in(3)) p.heat.air_exchange = 0;
}

// Makes solids of 2 to 16 materials, in half of all calls. It is for the last: it changes the volume, too.
inline void may_be_of_materials(Random& random, Parameters& p, Volume& v) {
  if (random.one_in(2)) return;
  const int count = random.any({2, 3, random.between(2, 16), 16});
  p.materials.assign(static_cast<std::size_t>(count), {});
  for (rule::SolidMaterial& row : p.materials) {
    const int least = p.material.freezing_point;
    row.melting_point = static_cast<rule::Temperature>(
        random.any({least, std::max(least, 1), int{p.material.melting_point}, random.between(least, 65535)}));
    do {
      row.warmth = static_cast<std::uint32_t>(random.any({4096, 65536, random.between(4096, 65536)}));
    } while (row.heat_at(row.melting_point) > 65535);
    const auto room = static_cast<std::int32_t>(65535 - row.heat_at(row.melting_point));
    row.latent_heat = static_cast<rule::Temperature>(random.any({0, room, random.below(room + 1)}));
    row.air_exchange = static_cast<std::uint16_t>(random.any({0, 43690, random.below(43691)}));
  }
  p.materials[0] = {.melting_point = p.material.melting_point,
                    .latent_heat = p.material.latent_heat,
                    .air_exchange = p.heat.air_exchange};
  for (std::size_t a = 0; a < p.materials.size(); ++a)
    for (std::size_t b = 0; b <= a; ++b) {
      const auto weight = [&](std::uint16_t of_first, std::int32_t most) {
        const std::int32_t other = random.any({0, most, random.below(most + 1)});
        return a == 0 ? of_first : static_cast<std::uint16_t>(other);
      };
      rule::SolidMaterial &one = p.materials[a], &two = p.materials[b];
      one.weight_face[b] = two.weight_face[a] = weight(p.heat.weight_face, 10922);
      one.weight_edge[b] = two.weight_edge[a] = weight(p.heat.weight_edge, 5461);
      one.weight_corner[b] = two.weight_corner[a] = weight(p.heat.weight_corner, 3640);
    }
  v.material = decltype(v.material)(v.grid);
  const bool mixed = random.one_in(2);  // else in blocks, as bodies are
  const int side = random.between(2, 40);
  const std::uint64_t turn = random.bits();
  for_each(whole(v.grid), [&](int x, int y, int z) {
    if (!v.solid.test(x, y, z)) return;
    const int block = x / side + 3 * (y / side) + 7 * (z / side);
    const int any =
        mixed ? random.below(count)
              : static_cast<int>((turn + static_cast<unsigned>(block)) % static_cast<unsigned>(count));
    v.material[v.at(x, y, z)] = static_cast<std::uint8_t>(any);
  });
}

inline void hostile_paper_law(Random& random, rule::PaperLaw& law) {
  law.neighbours = random.any({4, 8});
  law.threshold = static_cast<std::uint16_t>(random.any({0, 1, 1434, 65535}));
  law.use_table = law.neighbours == 4 && random.one_in(2);
  for (auto& row : law.table) {  // each row sums to at most 65536
    std::int32_t left = random.any({65536, random.below(65537)});
    for (std::uint16_t& share : row)
      left -= share = static_cast<std::uint16_t>(random.below(std::min(left, 65535) + 1));
    std::swap(row[0], row[static_cast<std::size_t>(random.below(4))]);
  }
  const std::int32_t most = rule::largest_share(law.neighbours);
  law.share = static_cast<std::uint16_t>(random.any({0, 8192, most}));
  law.downhill = !random.one_in(3);
  law.margin = static_cast<rule::Amount>(random.any({0, 1, 256, 65535}));
  law.support = random.one_in(2);
  law.slump = static_cast<rule::Amount>(random.any({0, 1, 1024}));
  law.reading = random.one_in(2) ? rule::EnergyReading::text : rule::EnergyReading::printed;
  law.beta = static_cast<std::uint32_t>(random.any({0, 40000, 65536, 131072, 262144}));
  law.alpha_liquid = static_cast<std::uint16_t>(random.any({0, 64000, 65535}));
  law.alpha_solid = static_cast<std::uint16_t>(random.any({0, 64000, 65535}));
  law.alpha_floor = static_cast<std::uint16_t>(random.any({0, 64000, 65535}));
  law.reheat = static_cast<std::uint16_t>(random.any({0, 1, 65535}));
}

inline Parameters hostile_parameters(Random& random, rule::Law law, Grid g) {
  Parameters p;
  p.seed = random.bits();
  hostile_heat_parameters(random, g, p);
  p.flow.law = law;
  if (law == rule::Law::paper) hostile_paper_law(random, p.flow.paper);
  p.flow.viscous = {random.any<std::uint64_t>({0, 19088744, 19088744000, (std::uint64_t{1} << 36) - 1}),
                    static_cast<std::uint32_t>(random.any({0, 131, (1 << 24) - 1})),
                    static_cast<std::uint8_t>(random.between(1, 8)),
                    static_cast<std::uint16_t>(random.any({1, 1, 2, 3, 0})),
                    static_cast<std::uint16_t>(random.any({1, 2, 5}))};
  p.flow.fall.factor = static_cast<std::uint32_t>(random.any({0, 30000, 65536}));
  p.flow.fall.wall_factor = static_cast<std::uint32_t>(random.any({0, 8192, 65536}));
  p.flow.fall.minimum = static_cast<rule::Amount>(random.any({0, 32, 65535}));
  p.flow.fall.hang = static_cast<rule::Amount>(random.any({0, 1024, 65535}));
  p.flow.thermal_viscosity = random.one_in(2);
  for (std::uint16_t& entry : p.flow.mobility_table)
    entry = static_cast<std::uint16_t>(random.any({0, 32768, 65535, random.below(65536)}));
  p.flow.mobility_reference = static_cast<std::uint16_t>(random.any({0, 65535, random.below(65536)}));
  p.flow.mobility_rate = static_cast<std::uint16_t>(random.any({0, 64, 512, 32767, random.below(32768)}));

  const auto region = [&]() -> rule::Region {
    return {{random.between(-16, 16 * g.x + 16), random.between(-16, 16 * g.y + 16),
             random.between(-16, 16 * g.z + 16)},
            random.between(0, 60)};
  };
  for (std::int32_t n = random.below(3); n > 0; --n)
    p.vents.push_back({region(), static_cast<rule::Amount>(random.any({1, 500, 65535})),
                       static_cast<rule::Temperature>(random.any({0, 40000, 65535})),
                       static_cast<rule::Energy>(random.any({0, 2000, 4096})),
                       static_cast<std::uint32_t>(random.below(3)),
                       static_cast<std::uint32_t>(random.between(1, 9))});
  for (std::int32_t n = random.below(3); n > 0; --n)
    p.drains.push_back({region(), static_cast<rule::Amount>(random.any({1, 500, 65535})),
                        static_cast<std::uint32_t>(random.below(3)),
                        static_cast<std::uint32_t>(random.between(1, 9))});
  p.open_border = random.one_in(4);
  return p;
}

inline Volume hostile_volume(Random& random, const Parameters& p, Grid g) {
  Volume v(g);
  const std::int32_t air = random.below(8), solid = random.below(4), inert = random.below(3),
                     liquid = random.between(1, 6);
  for_each(whole(g), [&](int x, int y, int z) {
    const std::int32_t kind = random.below(air + solid + inert + liquid);
    const std::int32_t a = hostile_amount(random), h = p.heat.enabled ? hostile_heat(random, p) : 0;
    if (kind < air) return;
    if (kind < air + solid) return put_solid(v, x, y, z, random.one_in(4) ? a : random.between(1, kOne), h);
    if (kind < air + solid + inert) {
      const bool wall = p.heat.walls && random.one_in(2);
      put_inert(v, x, y, z, random.any({wall ? 1 : 0, 1, 2048, 4095}));
      if (wall) v.heat[v.at(x, y, z)] = static_cast<std::uint16_t>(h);
      return;
    }
    const bool energy = p.flow.law == rule::Law::paper;
    put(v, x, y, z, a, energy ? random.any({0, 1, a - 1, a, random.below(a + 1)}) : 0, h);
  });
  return v;
}

// Makes a column of liquid whose settling keeps the order of heat, or just does not. It has films and heaps
// in layers. Its excesses lie at both ends of the range that keeps the order, and one beyond.
inline void put_layers(Random& random, Volume& v, int x, int z, bool hot) {
  const int kind = random.below(6), beyond = random.below(2);
  const int height = kind == 3 ? std::min(31, v.grid.y) : random.between(1, v.grid.y);
  const bool one_heat = random.one_in(4);
  std::int32_t heat = random.below(65536);
  for (int y = 0; y < height; ++y) {
    std::int32_t a = 0;
    if (kind == 0) a = random.between(2048, 4096);
    if (kind == 1) a = random.between(2048, 6200);
    if (kind == 2) a = random.one_in(3) ? 4096 : random.between(1, 12000);
    if (kind == 3) a = y == 0 ? 2049 - beyond : 2048;  // below the 30th face 15 cells are missing
    if (kind == 4) a = y == 0 ? 61440 : y == 1 ? 8191 + beyond : 0;
    if (kind == 5) a = 4096;
    if (!one_heat) heat = random.one_in(2) ? random.below(65536) : std::min(65535, heat + random.below(2));
    if (a > 0) put(v, x, y, z, a, 0, hot ? heat : 0);
  }
}

// Fills a grid with liquid up to ceilings of many heights. Columns lack or have up to ONE / 64 too much, or
// one unit more. Few have no ceiling, and that of some is the border.
inline void put_vaults(Random& random, Volume& v, bool hot) {
  v = Volume(v.grid);
  const auto heat = [&] { return hot ? random.below(65536) : 0; };
  const auto wall = [&](int x, int y, int z) {
    if (random.one_in(2)) return put_solid(v, x, y, z, random.between(1, kOne), heat());
    put_inert(v, x, y, z, random.any({0, 1024, 2048, 4095}));
  };
  for (int z = 0; z < v.grid.z; ++z)
    for (int x = 0; x < v.grid.x; ++x) {
      const int bottom = random.one_in(3) ? random.below(std::min(3, v.grid.y)) : 0;
      const int top = random.between(bottom + 1, v.grid.y), odd = random.between(bottom, top - 1);
      const std::int32_t excess = random.any({-65, -64, -9, 0, 0, 9, 64, 65});
      for (int y = 0; y < bottom; ++y) wall(x, y, z);
      for (int y = bottom; y < top; ++y) put(v, x, y, z, kOne + (y == odd ? excess : 0), 0, heat());
      if (top < v.grid.y && !random.one_in(8)) wall(x, top, z);
    }
}

// Takes matter and obstacles out of half of all pieces of 16 cells along x. Then empty vectors lie beside,
// above and in front of others.
inline void thin_out(Random& random, Volume& v) {
  constexpr int kPiece = 16;
  for (int z = 0; z < v.grid.z; ++z)
    for (int y = 0; y < v.grid.y; ++y)
      for (int first = 0; first < v.grid.x; first += kPiece) {
        if (random.one_in(2)) continue;
        for (int x = first; x < std::min(first + kPiece, v.grid.x); ++x) {
          put(v, x, y, z, 0);
          v.solid.set(x, y, z, false);
          v.inert.set(x, y, z, false);
        }
      }
}

}  // namespace voxmelt::worlds
