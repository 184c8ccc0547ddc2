// The head of a checkpoint as JSON text.
#pragma once

#include <filesystem>
#include <string>

#include "kernel/run/checkpoint/checkpoint.h"

namespace voxmelt::checkpoint {

std::string json_of(const Head& head);
// Throws Error naming `file`, and what is missing or out of its range.
Head head_of(const std::string& json, const std::filesystem::path& file);

}  // namespace voxmelt::checkpoint
