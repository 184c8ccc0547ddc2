// What is known of the ray caster's cycles before it runs: exact numbers in closed form. They hold without
// stalls; those of work and of bytes hold with stalls, too.
#pragma once

#include <cstdint>

#include "hwmodel/caster/model/configuration.h"

namespace voxmelt::hwmodel::raycast {

// Of all pipes together.
struct KnownPass {
  std::int64_t tiles = 0;
  std::int64_t rays = 0;          // busy cycles of set-up, and of each stage that every ray passes once
  std::int64_t tiles_busy = 0;    // of the stage that gives tiles their buffers
  std::int64_t set_up_fill = -1;  // cycles before the first ray of each pipe; -1: not known
  std::int64_t tiles_read = 0;    // from memory
  std::int64_t written_bytes = 0;
  std::int64_t bus_cycles = 0;    // of the memory, for these reads and for what is written
  std::int64_t least_cycles = 0;  // of the pass: no machine with so many pipes takes less
};
// The first pass, with one sample for each pixel.
KnownPass known_first(int width, int height, const Configuration& configuration);
// The second pass, with so many samples for each of the pixels that differ.
KnownPass known_second(int width, int height, std::int64_t pixels, int samples,
                       const Configuration& configuration);

// An upload of register words and bursts: its cycles without stalls.
std::int64_t known_upload(std::int64_t words, std::int64_t bursts, const Configuration& configuration);

}  // namespace voxmelt::hwmodel::raycast
