// The program voxmelt-hardware has the commands of voxmelt that need the hardware model. `voxmelt` starts it.
#include <filesystem>
#include <set>
#include <system_error>

#include "app/commands.h"
#include "app/print.h"
#include "app/resources.h"
#include "app/run_program.h"
#include "hwmodel/caster/faults/faults.h"
#include "hwmodel/explore/device.h"
#include "hwmodel/machine/presets/presets.h"
#include "hwmodel/memory/sheet.h"
#include "hwmodel/pipeline/faults/faults.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;

void list_faults() {
  for (const hwmodel::FaultInfo& fault : hwmodel::all_faults())
    print("{:<24} {:<14} {}\n", fault.name, fault.stage, fault.what);
  print("\nwith --picture, in the ray caster:\n");
  for (const hwmodel::raycast::FaultInfo& fault : hwmodel::raycast::all_faults())
    print("{:<24} {:<14} {}\n", fault.name, fault.stage, fault.what);
}

void list_presets() {
  std::set<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(resource_folder("presets"), ignored))
    if (entry.path().extension() == ".toml") files.insert(entry.path());
  for (const fs::path& file : files)
    print("{:<24} {}\n", file.stem().string(), hwmodel::load_preset(file, {}).title);
}

// Lists names for --device, and for --memory and hw.memory.
void list_devices() {
  for (const hwmodel::explore::NamedText& file : hwmodel::explore::device_files())
    print("{:<24} {}\n", file.name, hwmodel::explore::load_device(file.name, {}).title);
}

void list_memories() {
  for (const hwmodel::MemoryFile& file : hwmodel::memory_files())
    print("{:<24} {}\n", file.name, hwmodel::load_memory(file.name, "").title);
}

}  // namespace
}  // namespace voxmelt::app

int main(int argc, char** argv) {
  using namespace voxmelt::app;
  const auto add_commands = [](CommandLine& program) {
    add_verify(program);
    add_rtl(program);
    add_explore(program);
    add_list(program, {{"presets", list_presets},
                       {"devices", list_devices},
                       {"memories", list_memories},
                       {"faults", list_faults}});
  };
  return run_program("The hardware model of voxmelt, in lock-step with the software.", add_commands, argc,
                     argv);
}
