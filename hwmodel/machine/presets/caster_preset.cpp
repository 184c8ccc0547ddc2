#include "hwmodel/machine/presets/caster_preset.h"

#include <bit>
#include <cstdint>
#include <fstream>
#include <string>

#include "hwmodel/memory/sheet.h"

namespace voxmelt::hwmodel {
namespace {

int power_of_two(scene::Reader& hw, const std::string& key, int low, int high, int value) {
  value = static_cast<int>(hw.integer(key, low, high, value));
  if (!std::has_single_bit(static_cast<unsigned>(value)))
    hw.fail(key, " = " + std::to_string(value) + " is not a power of 2");
  return value;
}

struct CacheKeys {
  const char *sets, *ways, *spare, *queue;
};
constexpr CacheKeys kLevels{"levels_sets", "levels_ways", "levels_spare", "levels_queue"};
constexpr CacheKeys kMatter{"matter_sets", "matter_ways", "matter_spare", "matter_queue"};
constexpr CacheKeys kLight{"light_sets", "light_ways", "light_spare", "light_queue"};
constexpr CacheKeys kGround{"ground_sets", "ground_ways", "ground_spare", "ground_queue"};

// A request needs up to eight lines at once: with fewer to spare it could wait for itself.
void read_cache(scene::Reader& hw, const CacheKeys& keys, raycast::CacheShape& cache) {
  cache.sets = power_of_two(hw, keys.sets, 1, 65536, cache.sets);
  cache.ways = power_of_two(hw, keys.ways, 1, 64, cache.ways);
  cache.spare = static_cast<int>(hw.integer(keys.spare, 8, 256, cache.spare));
  cache.queue = static_cast<int>(hw.integer(keys.queue, 1, 1024, cache.queue));
}

}  // namespace

void read_clock_and_memory(scene::Reader& hw, raycast::Configuration& c) {
  c.clock_mhz = static_cast<int>(hw.integer("clock_mhz", 1, 10000, c.clock_mhz));
  const std::string memory = hw.text("memory", "fixed");
  if (memory != "fixed") c.dram = load_memory(memory, hw.place("memory").text());
}

void read_memory(scene::Reader& hw, raycast::Configuration& c) {
  read_clock_and_memory(hw, c);
  c.memory_trace = hw.text("memory_trace", "");
  if (c.memory_trace.empty()) return;
  if (!c.dram) hw.fail("memory_trace", ": hw.memory must be a DRAM");
  if (!std::ofstream(c.memory_trace)) hw.fail("memory_trace", ": cannot write " + c.memory_trace);
}

void read_caster(scene::Reader& hw, raycast::Configuration& c) {
  const auto number = [&](const char* key, int low, int high, int value) {
    return static_cast<int>(hw.integer(key, low, high, value));
  };
  c.pipes = number("pipes", 1, 64, c.pipes);
  c.rays = number("rays", 1, 4096, c.rays);
  c.walkers = number("walkers", 1, 16, c.walkers);
  c.searchers = number("searchers", 1, 16, c.searchers);
  c.fifo_depth = number("fifo_depth", 1, 1024, c.fifo_depth);
  c.stall_seed = static_cast<std::uint64_t>(hw.integer("stall_seed", 0, INT64_MAX, 0));
  c.tiles = number("tiles", 1, 64, c.tiles);
  c.clear_tiles = number("clear_tiles", 1, 64, c.clear_tiles);
  c.bands = number("bands", 1, 64, c.bands);
  c.latency = number("latency", 1, 1000, c.latency);
  c.bus_bytes = number("bus_bytes", 1, 4096, c.bus_bytes);
  c.apron = number("apron", 0, 1, c.apron ? 1 : 0) != 0;
  c.level_bits = number("level_bits", 1, 3, c.level_bits);
  read_memory(hw, c);
  read_cache(hw, kLevels, c.levels);
  read_cache(hw, kMatter, c.matter);
  read_cache(hw, kLight, c.light);
  read_cache(hw, kGround, c.ground);
}

}  // namespace voxmelt::hwmodel
