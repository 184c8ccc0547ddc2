// The numbers of memories come from TOML. The files in hwmodel/memory/sheets are held in the program, and a
// user may name a file of their own.
#pragma once

#include <string>
#include <vector>

#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel {

struct MemoryFile {
  std::string name, text;
};
const std::vector<MemoryFile>& memory_files();

// Loads a memory by the name of one of these files, or by the path of a file that ends in ".toml". Throws
// scene::InputError. The error names `place` if there is no such memory, else the place in the file.
memory::Parameters load_memory(const std::string& name, const std::string& place);

}  // namespace voxmelt::hwmodel
