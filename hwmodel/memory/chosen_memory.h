// A configuration chooses this memory: a DRAM, or one of a fixed latency.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hwmodel/fabric/memory_port.h"
#include "hwmodel/memory/counts.h"
#include "hwmodel/memory/dram.h"
#include "hwmodel/memory/fixed_latency.h"
#include "hwmodel/memory/parameters.h"
#include "hwmodel/memory/trace.h"

namespace voxmelt::hwmodel::memory {

struct Choice {
  std::optional<Parameters> dram;    // none: a fixed latency, as the next two say
  int latency = 40, bus_bytes = 64;  // cycles of the machine; bytes in each of them
  int clock_mhz = 200;               // clock of the machine
  std::string trace, command_trace;  // files for the requests to a DRAM, and its commands; empty: none

  double most_bytes_per_cycle() const {  // bytes per cycle of the machine
    return dram ? static_cast<double>(dram->peak()) / clock_mhz : bus_bytes;
  }
};

class ChosenMemory {
 public:
  // Throws std::runtime_error if a trace cannot be written.
  explicit ChosenMemory(const Choice& choice);

  Memory& memory() { return dram_ ? static_cast<Memory&>(*dram_) : *fixed_; }
  // Begins a job whose cycles count from 0. Nobody else uses the memory then.
  void begin_job() {
    if (fixed_) fixed_->begin_job();
  }
  std::optional<Counts> dram_counts() const { return dram_ ? std::optional(dram_->counts()) : std::nullopt; }
  // Counts the cycles of the machine in which the data bus carried bytes.
  std::int64_t bus_cycles() const;

 private:
  Choice choice_;
  std::optional<Dram> dram_;
  std::optional<FixedLatency> fixed_;
  std::optional<TraceFiles> traces_;
};

}  // namespace voxmelt::hwmodel::memory
