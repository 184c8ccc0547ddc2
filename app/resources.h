// Some files came with the program. They are beside it: bin/voxmelt and share/voxmelt/ may be moved together.
// A build folder has links to the source tree in the same places.
#pragma once

#include <filesystem>

namespace voxmelt::app {

// Returns share/voxmelt/NAME of this program: `scenes`, `presets` (hardware configurations), or `rtl` (stages
// in SystemVerilog). It need not exist.
std::filesystem::path resource_folder(const std::filesystem::path& name);

}  // namespace voxmelt::app
