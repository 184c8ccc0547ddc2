// Calm worlds: nearly everything sleeps, and small causes wake it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "tests/kernel/engine/scalar/hostile.h"

namespace voxmelt::worlds {

inline Grid calm_grid(Random& random) {
  const int kind = random.below(3);
  if (kind == 0) return {random.any({66, 130, 190}), random.between(3, 9), random.between(1, 5)};
  if (kind == 1) return {random.between(3, 9), random.between(4, 30), random.any({3, 6, 12})};
  return {random.between(3, 66), random.between(3, 9), random.any({8, 12, 17})};
}

inline rule::Region somewhere(Random& random, Grid g) {
  return {{16 * random.below(g.x) + 8, 16 * random.below(g.y) + 8, 16 * random.below(g.z) + 8},
          random.any({1, 17, 33})};
}

inline void calm_heat(Random& random, Grid g, Parameters& p) {
  p.heat.enabled = random.one_in(2);
  p.heat.neighbours = random.any({6, 18, 26});
  p.heat.weight_face = static_cast<std::uint16_t>(random.any({0, 40, 5000, 10922}));
  p.heat.weight_edge = static_cast<std::uint16_t>(random.any({0, 40, 5461}));
  p.heat.weight_corner = static_cast<std::uint16_t>(random.any({0, 40, 3640}));
  p.heat.convection = static_cast<std::uint16_t>(random.any({0, 40, 20000}));
  p.heat.air = random.one_in(3);
  p.heat.air_exchange = static_cast<std::uint16_t>(random.any({3, 500, 20000}));
  p.heat.air_temperature.assign(static_cast<std::size_t>(g.y), 30000);
  if (random.one_in(3)) p.heat.air_temperature[static_cast<std::size_t>(random.below(g.y))] = 42000;
  p.material.melting_point = static_cast<rule::Temperature>(random.any({30001, 30400, 36000}));
  p.material.latent_heat = static_cast<rule::Temperature>(random.any({0, 0, 300}));
  p.material.freezing_point = static_cast<rule::Temperature>(
      random.any({0, 0, 30000, 30001, std::int32_t{p.material.melting_point}}));
  p.heat.air_glow = static_cast<std::uint16_t>(random.any({0, 0, 0, 900}));
  p.heat.radiation = random.one_in(3);
  p.heat.visibility_every = static_cast<std::uint32_t>(random.any({1, 3, 7}));
  rule::HeatSource source;  // dark until it comes near
  const rule::Region at = somewhere(random, g);
  source.keys = {{random.one_in(2) ? 9u : 3u, at.at, 0},
                 {12, {at.at.x, at.at.y + 40, at.at.z}, std::uint64_t{1} << random.between(10, 30)},
                 {20, {at.at.x + 64, at.at.y, at.at.z}, 0}};
  p.heat.sources.assign(1, source);
}

inline Parameters calm_parameters(Random& random, rule::Law law, Grid g) {
  Parameters p = hostile_parameters(random, law, g);
  p.heat = {};
  p.material = {};
  calm_heat(random, g, p);
  p.flow.paper.downhill = !random.one_in(6);
  p.flow.paper.threshold = static_cast<std::uint16_t>(random.any({0, 1434}));
  p.flow.paper.margin = static_cast<rule::Amount>(random.any({1, 256, 3000}));
  p.flow.paper.reheat = static_cast<std::uint16_t>(random.any({0, 30, 30000}));
  p.flow.viscous.mobility = random.any<std::uint64_t>({0, 245760, 19088744, 819200000});
  p.flow.viscous.yield = static_cast<std::uint32_t>(random.any({0, 131, 60000}));
  p.flow.viscous.stages_max = random.any<std::uint16_t>({1, 1, 2, 16});
  if (random.one_in(2)) p.flow.fall = {};
  if (random.one_in(4)) p.flow.fall = {.factor = 65535, .wall_factor = 65535, .minimum = 0};
  p.vents.clear();
  p.drains.clear();
  const auto from = static_cast<std::uint32_t>(random.between(6, 14));
  if (random.one_in(3))
    p.vents.push_back({somewhere(random, g), static_cast<rule::Amount>(random.any({1, 500, 9000})),
                       static_cast<rule::Temperature>(random.any({30000, 50000})),
                       static_cast<rule::Energy>(random.any({0, 4096})), from, from + 3});
  if (random.one_in(3))
    p.drains.push_back(
        {somewhere(random, g), static_cast<rule::Amount>(random.any({1, 500, 9000})), from, from + 3});
  return p;
}

// Makes a few bodies in much air, all of about one heat.
inline Volume calm_volume(Random& random, const Parameters& p, Grid g) {
  Volume v(g);
  const bool floor = random.one_in(2);
  if (floor) for_each({0, 0, 0, g.x, 1, g.z}, [&](int x, int y, int z) { put_inert(v, x, y, z); });
  for (int body = random.between(1, 6); body > 0; --body) {
    const int x = random.below(g.x), y = random.between(floor, g.y - 1), z = random.below(g.z);
    const int size = random.between(1, 9), tall = random.any({1, 1, 2, 5, 20});
    const Box box{x,
                  y,
                  z,
                  std::min(g.x, x + random.any({1, size, 70})),
                  std::min(g.y, y + tall),
                  std::min(g.z, z + random.any({1, size}))};
    const int kind = random.below(5),
              heat = p.heat.enabled ? random.any({30000, 30000, 30000, 30010, 50000}) : 0;
    const int amount = random.any({300, 2048, 4096, 4096, 9000, random.one_in(3) ? 65535 : 4096});
    const int energy = p.flow.law == rule::Law::paper ? random.any({0, amount}) : 0;
    for_each(box, [&](int cx, int cy, int cz) {
      v.solid.set(cx, cy, cz, false);
      v.inert.set(cx, cy, cz, false);
      if (kind == 0)
        put_inert(v, cx, cy, cz);
      else if (kind <= 2)
        put_solid(v, cx, cy, cz, std::min(amount, rule::kOne), heat);
      else
        put(v, cx, cy, cz, amount, energy, heat);
    });
  }
  return v;
}

}  // namespace voxmelt::worlds
