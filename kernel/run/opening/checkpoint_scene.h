// Scenes are made from checkpoints here, and checkpoints from scenes. Every command that takes a scene takes
// a checkpoint, too.
#pragma once

#include <filesystem>
#include <string>

#include "kernel/run/checkpoint/checkpoint.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

namespace voxmelt::run {

// Tells if a file is a checkpoint, by its suffix or its first bytes.
bool is_checkpoint(const std::filesystem::path& file);

// Returns the scene as it was resolved, with the cells and the books of the checkpoint. It throws
// checkpoint::Error if this program would resolve it to other parameters, or the cells make no volume.
scene::Scene scene_of(checkpoint::Checkpoint checkpoint, const std::filesystem::path& file);

// Describes the scene's files as they are now, for the checkpoints of a run. `grid` is the scene's, whose
// cells may have moved away.
checkpoint::SceneText scene_text(const scene::Scene& scene, state::Grid grid);

// Returns everything but the command. `version` is that of the program.
checkpoint::Head head_of(const std::string& version, const checkpoint::SceneText& text,
                         const scene::Scene& scene, const Simulation& simulation);

}  // namespace voxmelt::run
