// Hardware configurations from TOML: a preset by name, a file of one's own, and --set hw.key=value. A file
// describes the whole machine: the pipeline, the ray caster, and the memory and the clock of both.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hwmodel/caster/model/configuration.h"
#include "hwmodel/pipeline/model/pipeline.h"

namespace voxmelt::hwmodel {

struct Preset {
  std::string title;
  Configuration configuration;    // of the pipeline
  raycast::Configuration caster;  // with the memory and the clock; has the same fifo_depth and stall_seed
};

// What is to run: an override of what does not is an error. A file may have keys of all.
enum class Runs : std::uint8_t { pipeline, caster, machine };

// Reads `file`; `overrides` are "hw.key=value", checked like the file. An empty path means the defaults.
// Throws scene::InputError with its place.
Preset load_preset(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                   Runs runs = Runs::pipeline);

}  // namespace voxmelt::hwmodel
