#include "hwmodel/memory/chosen_memory.h"

namespace voxmelt::hwmodel::memory {

ChosenMemory::ChosenMemory(const Choice& choice) : choice_(choice) {
  if (!choice.dram) {
    fixed_.emplace(choice.latency, choice.bus_bytes);
    return;
  }
  dram_.emplace(*choice.dram, choice.clock_mhz);
  traces_.emplace(choice.trace, choice.command_trace).attach(*dram_, 0);
}

std::int64_t ChosenMemory::bus_cycles() const {
  if (fixed_) return fixed_->bus_cycles();
  const Parameters& p = *choice_.dram;
  return dram_->counts().busy * choice_.clock_mhz / (std::int64_t{p.mhz} * p.channels);
}

}  // namespace voxmelt::hwmodel::memory
