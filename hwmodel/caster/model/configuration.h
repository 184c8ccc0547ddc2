// A ray caster is configured by these numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "hwmodel/fabric/key.h"
#include "hwmodel/memory/chosen_memory.h"
#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel::raycast {

struct CacheShape {
  int sets = 16, ways = 4;
  int spare = 32;  // more lines than tags: as many misses may be under way
  int queue = 64;  // requests between tag and data; their wait hides the memory's latency
  int lines() const { return sets * ways; }
};

struct Configuration {
  int pipes = 1;                 // number of pipes, W
  int rays = 64;                 // rays under way in the walk of a pipe
  int walkers = 4;               // steps through air in a cycle of a pipe
  int searchers = 4;             // steps over blocks of ground in a cycle of a pipe
  int fifo_depth = 4;            // tokens in each channel
  std::uint64_t stall_seed = 0;  // 0 for no stalls
  int tiles = 12;                // tile buffers of a pipe; rays of all of them are made in turn
  // If matter is clear, only so many are used. There a ray reads far more lines, and rays that are near share
  // them.
  int clear_tiles = 4;
  int bands = 16;  // bands of the picture, from which tiles are dealt in turn
  CacheShape levels{64}, matter{16}, light{32}, ground{64};
  int clock_mhz = 200;
  std::optional<memory::Parameters> dram;  // none: a fixed latency, as the next two say
  int latency = 40;                        // latency of the memory, in cycles
  int bus_bytes = 64;                      // bytes that the memory gives in a cycle
  std::string memory_trace;                // file of the requests to a DRAM; empty for none
  std::string command_trace;               // file of its commands; empty for none
  bool apron = false;                      // bricks of levels hold their apron: a line is a brick
  int level_bits = 2;  // log2 of the places of a line of levels along an axis, without apron: 1 to 3

  memory::Choice memory() const { return {dram, latency, bus_bytes, clock_mhz, memory_trace, command_trace}; }
  int tiles_in_turn(bool clear) const { return clear ? std::min(tiles, clear_tiles) : tiles; }
};

using CasterKey = Key<Configuration>;

// A cache's request needs up to eight lines at once: with fewer to spare it could wait for itself.
inline constexpr std::array kCasterKeys{
    hw_key<&Configuration::pipes>("pipes", 1, 64),
    hw_key<&Configuration::rays>("rays", 1, 4096),
    hw_key<&Configuration::walkers>("walkers", 1, 16),
    hw_key<&Configuration::searchers>("searchers", 1, 16),
    hw_key<&Configuration::fifo_depth>("fifo_depth", 1, 1024),
    hw_key<&Configuration::stall_seed>("stall_seed", 0, std::numeric_limits<std::int64_t>::max()),
    hw_key<&Configuration::tiles>("tiles", 1, 64),
    hw_key<&Configuration::clear_tiles>("clear_tiles", 1, 64),
    hw_key<&Configuration::bands>("bands", 1, 64),
    hw_key<&Configuration::latency>("latency", 1, 1000),
    hw_key<&Configuration::bus_bytes>("bus_bytes", 1, 4096),
    hw_key<&Configuration::apron>("apron", 0, 1),
    hw_key<&Configuration::level_bits>("level_bits", 1, 3),
    hw_key<&Configuration::levels, &CacheShape::sets>("levels_sets", 1, 65536, "1, 2, 4 .. 65536", true),
    hw_key<&Configuration::levels, &CacheShape::ways>("levels_ways", 1, 64, "1, 2, 4 .. 64", true),
    hw_key<&Configuration::levels, &CacheShape::spare>("levels_spare", 8, 256),
    hw_key<&Configuration::levels, &CacheShape::queue>("levels_queue", 1, 1024),
    hw_key<&Configuration::matter, &CacheShape::sets>("matter_sets", 1, 65536, "1, 2, 4 .. 65536", true),
    hw_key<&Configuration::matter, &CacheShape::ways>("matter_ways", 1, 64, "1, 2, 4 .. 64", true),
    hw_key<&Configuration::matter, &CacheShape::spare>("matter_spare", 8, 256),
    hw_key<&Configuration::matter, &CacheShape::queue>("matter_queue", 1, 1024),
    hw_key<&Configuration::light, &CacheShape::sets>("light_sets", 1, 65536, "1, 2, 4 .. 65536", true),
    hw_key<&Configuration::light, &CacheShape::ways>("light_ways", 1, 64, "1, 2, 4 .. 64", true),
    hw_key<&Configuration::light, &CacheShape::spare>("light_spare", 8, 256),
    hw_key<&Configuration::light, &CacheShape::queue>("light_queue", 1, 1024),
    hw_key<&Configuration::ground, &CacheShape::sets>("ground_sets", 1, 65536, "1, 2, 4 .. 65536", true),
    hw_key<&Configuration::ground, &CacheShape::ways>("ground_ways", 1, 64, "1, 2, 4 .. 64", true),
    hw_key<&Configuration::ground, &CacheShape::spare>("ground_spare", 8, 256),
    hw_key<&Configuration::ground, &CacheShape::queue>("ground_queue", 1, 1024),
};

inline constexpr int kTileSide = 8;  // pixels

}  // namespace voxmelt::hwmodel::raycast
