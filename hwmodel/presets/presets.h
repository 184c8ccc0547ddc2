// Hardware configurations from TOML: a preset by name, a file of one's own, and --set hw.key=value.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hwmodel/stream/pipeline.h"

namespace voxmelt::hwmodel {

struct Preset {
  std::string title;
  Configuration configuration;
};

// Reads `file`; `overrides` are "hw.key=value", checked like the file. An empty path means the defaults.
// Throws scene::InputError with its place.
Preset load_preset(const std::filesystem::path& file, const std::vector<std::string>& overrides);

}  // namespace voxmelt::hwmodel
