// Scenes from checkpoints: wherever a command takes a scene, it takes a checkpoint.
#pragma once

#include <filesystem>

#include "kernel/run/checkpoint/checkpoint.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

// By its suffix, or its first bytes.
bool is_checkpoint(const std::filesystem::path& file);

// The scene as it was resolved, with the cells and the books of the checkpoint. Throws checkpoint::Error
// where this program would resolve it to other parameters, or the cells make no volume.
scene::Scene scene_of(checkpoint::Checkpoint checkpoint, const std::filesystem::path& file);

// For the checkpoints of a run that begins: what its files are now.
checkpoint::SceneText scene_text(const scene::Scene& scene);

// Everything but the command.
checkpoint::Head head_of(const checkpoint::SceneText& text, const scene::Scene& scene,
                         const run::Simulation& simulation);

}  // namespace voxmelt::app
