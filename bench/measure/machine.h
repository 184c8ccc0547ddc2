// What this machine can do, measured in the same run as everything that is compared with it.
//
// Rates, but for those of the moment, are the best of several short trials: a bound that a busy machine had
// lowered would flatter us.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "kernel/engine/cpu/instruction_set.h"

namespace voxmelt::measure {

struct MachineText {
  std::string processor;
  int threads = 1;  // that the system offers
  std::size_t l1_bytes = 0, l2_bytes = 0, l3_bytes = 0, memory_bytes = 0;
};
MachineText describe_machine();

// Bytes per second, read and written bytes both counted.
struct Bandwidth {
  double copy = 0;    // memcpy from one half of the footprint to the other
  double update = 0;  // every number read, changed and written back in place: no line is fetched in vain
  double best() const { return copy > update ? copy : update; }
};

// Lanes of 16 bits per second, all threads together.
struct LaneRates {
  double multiply = 0, add = 0;
};

class Machine {
 public:
  // `trial_seconds`: how long one trial takes.
  explicit Machine(double trial_seconds = 0.02) : trial_seconds_(trial_seconds) {}

  // Of `threads` threads that share `footprint` bytes. Footprints are rounded to a power of two, 256 KiB to
  // 512 MiB.
  Bandwidth bandwidth(std::size_t footprint, int threads);
  LaneRates lane_rates(cpu::InstructionSet set, int threads);
  // What others leave to us at this moment: the better of two short trials, which nothing remembers.
  LaneRates lane_rates_now(cpu::InstructionSet set, int threads) const;

  // Measures again what has been measured, and keeps the better: others may have been at work then.
  void refresh_rates();
  void refresh_all();

  static std::size_t rounded(std::size_t footprint);

  // All that has been measured until now.
  const std::map<std::pair<std::size_t, int>, Bandwidth>& bandwidths() const { return bandwidths_; }
  const std::map<std::pair<cpu::InstructionSet, int>, LaneRates>& rates() const { return rates_; }

 private:
  Bandwidth measure(std::size_t footprint, int threads) const;
  static LaneRates measure(cpu::InstructionSet set, int threads, int trials, double trial_seconds);

  double trial_seconds_;
  std::map<std::pair<std::size_t, int>, Bandwidth> bandwidths_;
  std::map<std::pair<cpu::InstructionSet, int>, LaneRates> rates_;
};

}  // namespace voxmelt::measure
