// The head of a checkpoint is JSON text.
#pragma once

#include <filesystem>
#include <string>

#include "kernel/run/checkpoint/checkpoint.h"

namespace voxmelt::checkpoint {

std::string json_of(const Head& head);
// Reads a head. It throws Error with the name of `file` and of the value that is missing or out of its range.
Head head_of(const std::string& json, const std::filesystem::path& file);

}  // namespace voxmelt::checkpoint
