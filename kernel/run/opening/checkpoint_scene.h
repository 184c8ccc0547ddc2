// Scenes from checkpoints, and checkpoints of scenes: wherever a scene is taken, a checkpoint is, too.
#pragma once

#include <filesystem>
#include <string>

#include "kernel/run/checkpoint/checkpoint.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

namespace voxmelt::run {

// By its suffix, or its first bytes.
bool is_checkpoint(const std::filesystem::path& file);

// The scene as it was resolved, with the cells and the books of the checkpoint. Throws checkpoint::Error
// where this program would resolve it to other parameters, or the cells make no volume.
scene::Scene scene_of(checkpoint::Checkpoint checkpoint, const std::filesystem::path& file);

// For the checkpoints of a run: what the scene's files are now. `grid` is the scene's, whose cells may have
// moved away.
checkpoint::SceneText scene_text(const scene::Scene& scene, state::Grid grid);

// Everything but the command. `version` is that of the program.
checkpoint::Head head_of(const std::string& version, const checkpoint::SceneText& text,
                         const scene::Scene& scene, const Simulation& simulation);

}  // namespace voxmelt::run
