// The state as grids of OpenVDB: density, liquid, solid, inert and temperature, of floats.
#pragma once

#include <filesystem>
#include <string>

#include "kernel/run/io/export.h"

namespace voxmelt::io {

// Writes volume.vdb, by the program voxmelt-vdb. It throws OutputError, also where that is not there.
void export_vdb(const Moment& moment, const std::filesystem::path& folder, const Poll& poll);

// Says how to get that program, or nothing if it is there.
std::string missing_for_vdb();

}  // namespace voxmelt::io
