// What the stages of a pipe count of each ray in a pass: how many steps it took, what it asked for and how
// many lines that missed. The forecast (forecast.h) knows nothing else of a picture.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/caster/model/ray_id.h"

namespace voxmelt::hwmodel::raycast {

struct RayEvent {
  Asked kind = Asked::look;
  std::uint8_t misses = 0;  // lines that were not in the cache
  std::uint8_t lost = 0;    // lines that lost their tags to them
  bool looked_up = false;   // of a request: misses are known
  std::uint16_t before =
      0;  // steps of the ray since the event before, in search of the ground or in the walk
};
struct TileCount {
  std::int32_t rays = 0;
  std::uint8_t reads = 0;  // bit i: tile i of those that the second pass may read
};

struct PipeCounts {
  static constexpr std::size_t kCaches = 5;  // in the order of Pipe::caches
  std::vector<std::vector<RayEvent>> rays;   // tile by tile
  std::vector<TileCount> tiles;
  std::array<int, kCaches> free{};  // lines of each cache that hold nothing, at the begin

  // The number of its first ray.
  std::int32_t begin_tile(const TileCount& tile) {
    const std::size_t first = rays.size();
    tiles.push_back(tile);
    rays.resize(first + static_cast<std::size_t>(tile.rays));
    return static_cast<std::int32_t>(first);
  }
  void steps_before(const RayId& id, Asked kind, int steps) {
    rays[static_cast<std::size_t>(id.number)].push_back(
        {kind, 0, 0, false, static_cast<std::uint16_t>(steps < 65535 ? steps : 65535)});
  }
  void looked_up(const RayId& id, Asked kind, int misses, int lost) {
    std::vector<RayEvent>& events = rays[static_cast<std::size_t>(id.number)];
    // The walk and the search for the ground have told their steps before.
    if (events.empty() || events.back().kind != kind || events.back().looked_up) events.push_back({kind});
    RayEvent& of = events.back();
    of.misses = static_cast<std::uint8_t>(misses), of.lost = static_cast<std::uint8_t>(lost);
    of.looked_up = true;
  }
};

}  // namespace voxmelt::hwmodel::raycast
