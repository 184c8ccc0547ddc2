// All fields as cell data of one VTK image, in zlib blocks, with the time step of the state.
// The layout is that of VTK's XML formats: appended raw data, a header of block sizes before each array.
#pragma once

#include <cstddef>
#include <filesystem>

#include "kernel/run/io/export.h"

namespace voxmelt::io {

inline constexpr const char* kVtiFile = "volume.vti";

// Writes volume.vti. The sizes of packed blocks stand before them, so all is packed twice but what fits
// `most_kept` bytes.
void write_vti(const Moment& moment, const std::filesystem::path& folder, const Poll& poll,
               std::size_t most_kept);

// The same, with 64 MiB that are kept.
void export_vti(const Moment& moment, const std::filesystem::path& folder, const Poll& poll);

}  // namespace voxmelt::io
