// A run that goes on takes files over from the folder of its former part.
#pragma once

#include <filesystem>

namespace voxmelt::app {

// Gives a file a second name, or copies it where the file system has no links. Throws io::OutputError.
void link_or_copy(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace voxmelt::app
