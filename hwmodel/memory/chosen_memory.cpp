#include "hwmodel/memory/chosen_memory.h"

#include <stdexcept>

namespace voxmelt::hwmodel::memory {

ChosenMemory::ChosenMemory(const Choice& choice) : choice_(choice) {
  if (!choice.dram) {
    fixed_.emplace(choice.latency, choice.bus_bytes);
    return;
  }
  dram_.emplace(*choice.dram, choice.clock_mhz);
  if (choice.trace.empty()) return;
  trace_file_.open(choice.trace);
  if (!trace_file_) throw std::runtime_error(choice.trace + ": error: cannot be written");
  trace_.emplace(trace_file_, choice.trace.ends_with(".stl") ? TraceFormat::dramsys : TraceFormat::ramulator);
  dram_->trace(&*trace_);
}

std::int64_t ChosenMemory::bus_cycles() const {
  if (fixed_) return fixed_->bus_cycles();
  const Parameters& p = *choice_.dram;
  return dram_->counts().busy * choice_.clock_mhz / (std::int64_t{p.mhz} * p.channels);
}

}  // namespace voxmelt::hwmodel::memory
