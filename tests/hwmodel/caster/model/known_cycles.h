// Some of the ray caster's cycles are known before it runs: exact numbers in closed form. They hold without
// stalls. Those of work and of bytes hold with stalls, too.
#pragma once

#include <cstdint>

#include "hwmodel/caster/model/configuration.h"

namespace voxmelt::hwmodel::raycast {

// Holds the numbers of all pipes together.
struct KnownPass {
  std::int64_t tiles = 0;
  std::int64_t rays = 0;          // busy cycles of set-up, and of each stage that every ray passes once
  std::int64_t tiles_busy = 0;    // busy cycles of the stage that gives tiles their buffers
  std::int64_t set_up_fill = -1;  // cycles before the first ray of each pipe; -1: not known
  std::int64_t tiles_read = 0;    // tiles that are read from memory
  std::int64_t written_bytes = 0;
  std::int64_t bus_cycles = 0;    // the memory's bus cycles for these reads and for what is written
  std::int64_t least_cycles = 0;  // a lower bound of the pass for this number of pipes
};
// Returns the numbers of the first pass, with one sample for each pixel.
KnownPass known_first(int width, int height, const Configuration& configuration);
// Returns those of the second pass, with `samples` samples for each of the `pixels` that differ.
KnownPass known_second(int width, int height, std::int64_t pixels, int samples,
                       const Configuration& configuration);

// Returns the cycles of an upload of register words and bursts, without stalls.
std::int64_t known_upload(std::int64_t words, std::int64_t bursts, const Configuration& configuration);

}  // namespace voxmelt::hwmodel::raycast
