// Ramulator 2 describes a memory in its YAML configuration, by presets and by numbers beside them. Those of
// DDR4 are read as sheets. A preset is what JESD79-4 says of a grade and of a part, as Ramulator rounds it.
// Ramulator leaves out a read's way through controller and pins: 20 ns are assumed.
#pragma once

#include <string>

#include "kernel/scene/text/document.h"

namespace voxmelt::hwmodel {

// Returns the sheet as a document. Throws scene::InputError, which names the file and its line or key.
scene::Value import_ramulator(const std::string& file);

}  // namespace voxmelt::hwmodel
