// The numbers of memories come from TOML. The files in hwmodel/memory/sheets are held in the program, and a
// user may name a file of their own. That may be TOML, or a file of DRAMSys or Ramulator.
#pragma once

#include <string>
#include <vector>

#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel {

struct MemoryFile {
  std::string name, text;
};
const std::vector<MemoryFile>& memory_files();

// Says if this is the path of a file, by its end: ".toml", ".json" (DRAMSys) or ".yaml" (Ramulator 2).
bool is_memory_file(const std::string& name);

// Loads a memory by the name of one of these files, or by the path of a file. Throws scene::InputError. The
// error names `place` if there is no such memory, else the place in the file. `overrides` are such as
// "memory.channels=4".
memory::Parameters load_memory(const std::string& name, const std::string& place,
                               const std::vector<std::string>& overrides = {});
}  // namespace voxmelt::hwmodel
