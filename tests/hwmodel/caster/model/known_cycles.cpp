#include "tests/hwmodel/caster/model/known_cycles.h"

#include <algorithm>

#include "hwmodel/caster/model/layout.h"
#include "hwmodel/caster/model/tile_stages.h"

namespace voxmelt::hwmodel::raycast {
namespace {

constexpr int kBeforeRays = 2;  // cycles: the dealer's channel, and the one from tiles to set-up
constexpr int kAskedFor = 5;    // tiles: in the second pass, the tile itself and those beside it
constexpr int kBurstsOfTile = kTileBytes / kBurst;

std::int64_t divided_up(std::int64_t a, std::int64_t b) { return (a + b - 1) / b; }

KnownPass of_rays(int width, int height, std::int64_t rays, const Configuration& c) {
  KnownPass pass;
  pass.tiles = divided_up(width, kTileSide) * divided_up(height, kTileSide);
  pass.rays = rays;
  pass.written_bytes = pass.tiles * kTileBytes;
  pass.bus_cycles = pass.tiles * kBurstsOfTile * divided_up(kBurst, c.bus_bytes);
  // The memory takes a burst a cycle, and set-up gives a ray a cycle and pipe.
  pass.least_cycles = std::max(divided_up(rays, c.pipes), pass.tiles * kBurstsOfTile);
  return pass;
}

}  // namespace

KnownPass known_first(int width, int height, const Configuration& c) {
  KnownPass pass = of_rays(width, height, std::int64_t{width} * height, c);
  pass.tiles_busy = pass.tiles;
  // Pipe i gets its first tile in cycle i.
  if (pass.tiles >= c.pipes && c.stall_seed == 0)
    pass.set_up_fill = std::int64_t{c.pipes} * kBeforeRays + std::int64_t{c.pipes} * (c.pipes - 1) / 2;
  return pass;
}

KnownPass known_second(int width, int height, std::int64_t pixels, int samples, const Configuration& c) {
  KnownPass pass = of_rays(width, height, pixels * samples, c);
  pass.tiles_busy = pass.tiles * (kAskedFor + 1);
  // A tile at a side of the picture has nothing beside it there.
  pass.tiles_read =
      pass.tiles * kAskedFor - 2 * (divided_up(width, kTileSide) + divided_up(height, kTileSide));
  pass.bus_cycles += pass.tiles_read * divided_up(kTileBytes, c.bus_bytes);
  return pass;
}

std::int64_t known_upload(std::int64_t words, std::int64_t bursts, const Configuration& c) {
  if (bursts == 0) return words;
  // A channel of depth 1 takes a burst every second cycle. The last one leaves it a cycle later.
  const std::int64_t apart =
      std::max<std::int64_t>(divided_up(kBurst, c.bus_bytes), c.fifo_depth == 1 ? 2 : 1);
  return words + (bursts - 1) * apart + 2;
}

}  // namespace voxmelt::hwmodel::raycast
