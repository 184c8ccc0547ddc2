// DRAMSys describes a memory by a JSON file (configs/memspec there). Those of DDR3, DDR4 and LPDDR4 are read
// as sheets. DRAMSys leaves some numbers to its controller, and these are assumed: cycles of the command
// bus, and 20 ns on a read's way.
#pragma once

#include <string>

#include "kernel/scene/text/document.h"

namespace voxmelt::hwmodel {

// Returns the sheet as a document. Throws scene::InputError, which names the file and its key.
scene::Value import_dramsys(const std::string& file);

}  // namespace voxmelt::hwmodel
