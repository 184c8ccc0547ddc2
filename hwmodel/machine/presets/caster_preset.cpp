#include "hwmodel/machine/presets/caster_preset.h"

#include <fstream>
#include <string>

#include "hwmodel/machine/presets/keys.h"
#include "hwmodel/memory/sheet.h"

namespace voxmelt::hwmodel {
void read_clock_and_memory(scene::Reader& hw, raycast::Configuration& c) {
  c.clock_mhz = hw.integer("clock_mhz", 1, 10000, c.clock_mhz);
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
  read_keys(hw, raycast::kCasterKeys, c);
  read_memory(hw, c);
}

}  // namespace voxmelt::hwmodel
