// Numbers of memories from TOML: those in memories/, which the program holds, or a file of one's own.
#pragma once

#include <string>
#include <vector>

#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel {

struct MemoryFile {
  std::string name, text;
};
const std::vector<MemoryFile>& memory_files();

// By the name of one of them, or the path of a file that ends in ".toml". Throws scene::InputError: with
// `place` in front where there is no such memory, else with the place in the file.
memory::Parameters load_memory(const std::string& name, const std::string& place);

}  // namespace voxmelt::hwmodel
