// The rates of this machine are measured in the same run as everything that is compared with them.
//
// Rates are the best of many short trials, as times are minima. A roof that a busy machine lowered would
// flatter the program.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "kernel/engine/cpu/instruction_set.h"
#include "measure/rounds.h"

namespace voxmelt::measure {

struct MachineText {
  std::string processor;
  int threads = 1;  // threads of the processor
  std::size_t l1_bytes = 0, l2_bytes = 0, l3_bytes = 0, memory_bytes = 0;
};
MachineText describe_machine();
double load_average();  // mean of the last minute: threads of the whole system that run or want to

// Counts bytes per second, read and written bytes both.
struct Bandwidth {
  double copy = 0;    // memcpy from one half of the footprint to the other
  double update = 0;  // every number read, changed and written in place: no cache line is fetched in vain
  double best() const { return copy > update ? copy : update; }
};

// Counts lanes of 16 bits per second, all threads together.
struct LaneRates {
  double multiply = 0, add = 0;
};

class Machine {
 public:
  // The argument `trials` sets the number of trials of each rate, a millisecond each.
  explicit Machine(const Rounds& trials = {.fewest = 5, .seconds = 0.2}) : trials_(trials) {}

  // Measures `threads` threads that share `footprint` bytes, rounded to a power of two from 256 KiB to 512
  // MiB.
  Bandwidth bandwidth(std::size_t footprint, int threads);
  LaneRates lane_rates(cpu::InstructionSet set, int threads);

  // Measures everything again and keeps the better rate, because the machine may have been busy before.
  void refresh_rates();
  void refresh_all();

  static std::size_t rounded(std::size_t footprint);

  // Returns all that has been measured so far.
  const std::map<std::pair<std::size_t, int>, Bandwidth>& bandwidths() const { return bandwidths_; }
  const std::map<std::pair<cpu::InstructionSet, int>, LaneRates>& rates() const { return rates_; }

 private:
  Bandwidth measure(std::size_t footprint, int threads) const;
  LaneRates measure(cpu::InstructionSet set, int threads) const;

  Rounds trials_;
  std::map<std::pair<std::size_t, int>, Bandwidth> bandwidths_;
  std::map<std::pair<cpu::InstructionSet, int>, LaneRates> rates_;
};

}  // namespace voxmelt::measure
