// Hardware configurations are read from TOML: a preset by name, a file of one's own, and --set hw.key=value.
// A file describes the whole machine: the pipeline, the ray caster, and the memory and the clock of both.
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
  Configuration configuration;    // pipeline
  raycast::Configuration caster;  // ray caster, memory and clock; has the same fifo_depth and stall_seed
};

// Names the parts that are to run. An override for any other part is an error. A file may have keys of all
// parts.
enum class Runs : std::uint8_t { pipeline, caster, machine };

// Reads `file`, then applies `overrides` such as "hw.key=value", which are checked like the file. An empty
// path means the defaults. Throws scene::InputError with its place.
Preset load_preset(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                   Runs runs = Runs::pipeline);

}  // namespace voxmelt::hwmodel
