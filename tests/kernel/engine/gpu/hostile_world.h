// Random and hostile worlds on small grids that straddle words and bricks.
#pragma once

#include <cstdint>

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

}  // namespace voxmelt::worlds
