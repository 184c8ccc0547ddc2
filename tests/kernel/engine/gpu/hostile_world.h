// Random and hostile worlds on small grids that straddle words and bricks.
#pragma once

#include <algorithm>
#include <cstdint>

#include "tests/kernel/engine/parallel/calm.h"
#include "tests/kernel/engine/scalar/hostile.h"

namespace voxmelt::worlds {

struct HostileWorld {
  Parameters parameters;
  Volume start;
};

inline Grid grid_across_bricks(Random& random) {
  const int kind = random.below(4);
  if (kind == 0)
    return {random.any({1, 2, 31, 32, 33, 63, 64, 65, 100}), random.between(1, 5), random.between(1, 5)};
  if (kind == 1)
    return {random.between(1, 40), random.any({1, 2, 3, 4, 5, 7, 8, 9, 16, 17, 40}), random.between(1, 3)};
  if (kind == 2)
    return {random.between(1, 12), random.between(1, 6), random.any({1, 3, 4, 5, 7, 8, 9, 16, 33})};
  return {random.between(3, 40), random.between(3, 24), random.between(3, 24)};
}

inline HostileWorld hostile_world(int seed, rule::Law law) {
  Random random(static_cast<std::uint64_t>(seed) * 7919 + (law == rule::Law::paper ? 1 : 2));
  const Grid grid = grid_across_bricks(random);
  Parameters parameters = hostile_parameters(random, law, grid);
  may_freeze(random, parameters);
  if (seed % 3 == 0) parameters.flow.viscous.stages_max = random.any<std::uint16_t>({2, 3, 5, 16});
  if (random.one_in(3)) parameters.heat = {};
  Volume start = hostile_volume(random, parameters, grid);
  if (seed % 2 == 1) thin_out(random, start);
  may_be_of_materials(random, parameters, start);
  return {parameters, start};
}

// Makes a room with a few blobs, many of them at the corners of bricks. So most bricks hold no matter, and it
// moves from one into another.
inline HostileWorld sparse_world(int seed, rule::Law law) {
  Random random(static_cast<std::uint64_t>(seed) * 6151 + (law == rule::Law::paper ? 1 : 2));
  const Grid grid{random.between(33, 110), random.between(9, 33), random.between(9, 33)};
  Parameters parameters = hostile_parameters(random, law, grid);
  parameters.flow.fall.factor = parameters.flow.fall.wall_factor = random.any({65536, 40000});
  parameters.flow.paper.threshold = 0;
  parameters.flow.paper.margin = 16;
  parameters.flow.paper.share = 8192;
  parameters.flow.paper.downhill = true;
  may_freeze(random, parameters);
  Volume volume(grid);
  const auto place = [&](int side, int brick) {
    const int corner = brick * random.between(0, side / brick) - random.below(2);
    return std::min(side - 1, std::max(0, random.one_in(3) ? random.below(side) : corner));
  };
  for (int blob = random.between(3, 9); blob > 0; --blob) {
    const int x0 = place(grid.x, 32), y0 = place(grid.y, 4), z0 = place(grid.z, 4), kind = random.below(4);
    const Box box{x0,
                  y0,
                  z0,
                  std::min(grid.x, x0 + random.between(1, 3)),
                  std::min(grid.y, y0 + random.between(1, 4)),
                  std::min(grid.z, z0 + random.between(1, 3))};
    for_each(box, [&](int x, int y, int z) {
      if (volume.amount[volume.at(x, y, z)] > 0) return;
      const int heat = parameters.heat.enabled ? hostile_heat(random, parameters) : 0;
      const int amount = random.one_in(4) ? random.between(kOne, 65535) : random.between(1, kOne);
      if (kind == 0) return put_solid(volume, x, y, z, random.between(1, kOne), heat);
      if (kind == 1 && y == y0) return put_inert(volume, x, y, z);
      put(volume, x, y, z, amount, law == rule::Law::paper ? amount : 0, heat);
    });
  }
  return {parameters, volume};
}

inline HostileWorld calm_world(int seed, rule::Law law) {
  Random random(static_cast<std::uint64_t>(seed) * 104729 + static_cast<std::uint64_t>(law));
  const Grid grid = calm_grid(random);
  const Parameters parameters = calm_parameters(random, law, grid);
  return {parameters, calm_volume(random, parameters, grid)};
}

}  // namespace voxmelt::worlds
