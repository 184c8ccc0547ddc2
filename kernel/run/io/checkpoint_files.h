// The checkpoints of a run are in a folder of its output, which holds the last two.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace voxmelt::io {

// Returns FOLDER/checkpoints/step_00001234.vxc.
inline constexpr const char* kLastState = "last.vxc";  // of a complete run

std::filesystem::path checkpoint_place(const std::filesystem::path& folder, std::uint32_t step);

// Lists the checkpoints of an output folder, the newest first, by their names. No file is looked into.
struct CheckpointFile {
  std::uint32_t step = 0;
  std::filesystem::path file;
};
std::vector<CheckpointFile> checkpoints_in(const std::filesystem::path& folder);
// Tells if there is one after the first step. A run that ends at its first step can be repeated as well.
bool holds_work(const std::filesystem::path& folder);

// Removes an output folder, its checkpoints first. If a process dies meanwhile, every checkpoint that is left
// has its frames.
void remove_output(const std::filesystem::path& folder);

// Removes all but the two newest, and any file that a dead process left half written.
void keep_two_checkpoints(const std::filesystem::path& folder);

}  // namespace voxmelt::io
