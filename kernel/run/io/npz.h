// All fields as the arrays of one npz file: a ZIP archive of npy files, not packed, as numpy.savez writes it.
#pragma once

#include <filesystem>

#include "kernel/run/io/export.h"

namespace voxmelt::io {

// Writes fields.npz. It throws OutputError where the file would not fit 4 GiB, the most that its offsets say.
void export_npz(const Moment& moment, const std::filesystem::path& folder, const Poll& poll);

}  // namespace voxmelt::io
