// Reads a whole file up to a limit of its size. A failure is one clear line.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace voxmelt::scene {

// The bytes of `file`. Throws InputError "<where>: error: ..." when it is missing, a folder or larger
// than `limit`.
std::string read_text_file(const std::filesystem::path& file, std::size_t limit, const std::string& where);

}  // namespace voxmelt::scene
