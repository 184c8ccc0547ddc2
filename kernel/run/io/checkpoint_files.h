// Where the checkpoints of a run are: a folder of its output that holds the last two.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace voxmelt::io {

// FOLDER/checkpoints/step_00001234.vxc
std::filesystem::path checkpoint_place(const std::filesystem::path& folder, std::uint32_t step);

// Those of an output folder, the newest first, by their names. No file is looked into.
struct CheckpointFile {
  std::uint32_t step = 0;
  std::filesystem::path file;
};
std::vector<CheckpointFile> checkpoints_in(const std::filesystem::path& folder);
// Is there one after the first step? A run that ends there can be repeated as well.
bool holds_work(const std::filesystem::path& folder);

// Its checkpoints go first: where a process dies meanwhile, those that are left have their frames.
void remove_output(const std::filesystem::path& folder);

// Removes all but the two newest, and what a dead process left half written.
void keep_two_checkpoints(const std::filesystem::path& folder);

}  // namespace voxmelt::io
