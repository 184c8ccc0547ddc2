// A replay is the state before a mismatch as a scene. `voxmelt verify FOLDER/scene.toml` finds the mismatch
// again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "kernel/automaton/state/volume.h"

namespace voxmelt::hwmodel {

// Fills `folder` with the fields and scene.toml, which extends `scene`. `command` shows the mismatch again,
// with the overrides of the scene in force. It goes into the file's head as a comment.
void write_replay(const std::filesystem::path& folder, const std::filesystem::path& scene,
                  const state::Volume& volume, std::uint32_t step, const std::string& command);

}  // namespace voxmelt::hwmodel
