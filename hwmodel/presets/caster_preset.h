// Configurations of the ray caster from TOML, as those of the pipeline (presets.h).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hwmodel/raycast/configuration.h"

namespace voxmelt::hwmodel {

struct CasterPreset {
  std::string title;
  raycast::Configuration configuration;
};

// `overrides` are "hw.key=value". Throws scene::InputError with its place.
CasterPreset load_caster_preset(const std::filesystem::path& file, const std::vector<std::string>& overrides);

}  // namespace voxmelt::hwmodel
