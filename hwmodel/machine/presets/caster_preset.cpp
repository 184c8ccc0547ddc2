#include "hwmodel/machine/presets/caster_preset.h"

#include <fstream>
#include <string>

#include "hwmodel/machine/presets/keys.h"
#include "hwmodel/memory/sheet.h"

namespace voxmelt::hwmodel {
namespace {

void read_trace(scene::Reader& hw, const char* key, std::string& trace, bool dram) {
  trace = hw.text(key, "");
  if (trace.empty()) return;
  if (!dram) hw.fail(key, ": hw.memory must be a DRAM");
  if (!std::ofstream(trace)) hw.fail(key, ": cannot write " + trace);
}

}  // namespace

void read_memory(scene::Reader& hw, raycast::Configuration& c) {
  c.clock_mhz = hw.integer("clock_mhz", 1, 10000, c.clock_mhz);
  const std::string memory = hw.text("memory", "fixed");
  if (memory != "fixed") c.dram = load_memory(memory, hw.place("memory").text());
  read_trace(hw, "memory_trace", c.memory_trace, c.dram.has_value());
  read_trace(hw, "command_trace", c.command_trace, c.dram.has_value());
}

void read_caster(scene::Reader& hw, raycast::Configuration& c) {
  read_keys(hw, raycast::kCasterKeys, c);
  read_memory(hw, c);
}

}  // namespace voxmelt::hwmodel
