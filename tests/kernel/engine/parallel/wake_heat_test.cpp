// Heat that moves in one pass of a step may move on in the next one, into a tile that slept until then. The
// bits must be the reference's after every phase, with the smallest tiles.
#include <cstdint>

#include "tests/kernel/engine/parallel/equal.h"
#include "tests/rounds.h"

namespace voxmelt::parallel {
namespace {

using namespace worlds;

// Makes a scene of solids that only conduct. With two materials every cell gathers from all its sides.
Parameters conducting(Random& random, int neighbours, bool materials) {
  Parameters p = paper_showcase();
  p.heat = {};
  p.heat.enabled = true;
  p.heat.neighbours = neighbours;
  p.heat.weight_face = static_cast<std::uint16_t>(random.between(7000, 10922));
  p.heat.weight_edge = static_cast<std::uint16_t>(random.between(3000, 5461));
  p.heat.weight_corner = static_cast<std::uint16_t>(random.between(2000, 3640));
  p.material = {};
  p.material.melting_point = 60000;
  if (!materials) return p;
  p.materials.assign(2, {});
  for (rule::SolidMaterial& row : p.materials) {
    row.melting_point = 60000;
    row.weight_face.fill(p.heat.weight_face);
    row.weight_edge.fill(p.heat.weight_edge);
    row.weight_corner.fill(p.heat.weight_corner);
  }
  return p;
}

// A block of one heat has a few units more in a cell beside a tile's edge. They rest for some steps. Their
// tile is restless and the next one sleeps. Then they pass over a face to the edge, and over an edge or a
// corner into the next tile, in one step.
TEST(Sleep, HeatThatHasJustComeMovesOn) {
  for (const bool materials : {true, false})
    for (const int neighbours : {18, 26})
      for (int seed = 0; seed < rounds(60); ++seed) {
        Random random(seed);
        const Parameters p = conducting(random, neighbours, materials);
        Volume start({130, 5, 4});
        for_each(whole(start.grid), [&](int x, int y, int z) { put_solid(start, x, y, z, 4096, 30000); });
        const int x = random.between(61, 66), y = random.below(5), z = random.below(4);
        put_solid(start, x, y, z, 4096, 30000 + random.between(1, 3));
        if (materials) {
          start.material = decltype(start.material)(start.grid);
          start.material[start.at(5, 0, 0)] = 1;
        }
        const step::Tuning tuning{.threads = 1, .sleep = true, .tile_shift = random.any({0, 1, 3})};
        ASSERT_TRUE(same_steps(p, start, fast_implementations().back(), tuning, 30)) << "seed " << seed;
      }
}

}  // namespace
}  // namespace voxmelt::parallel
