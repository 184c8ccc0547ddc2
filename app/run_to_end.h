// The run of `voxmelt run`, once it is prepared: steps, frames, checkpoints, outputs.
#pragma once

#include <chrono>
#include <memory>

#include "app/run_record.h"
#include "kernel/run/checkpoint/checkpoint.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

// A run that can begin, or go on.
struct PreparedRun {
  scene::Scene scene;
  checkpoint::SceneText text;
  RunRecord record;
  std::unique_ptr<io::OutputFolder> out;
};

// From where it is to its end, or to a signal, or until the disk is full. `start` is when the command began.
// Returns the exit code.
int run_to_end(PreparedRun run, std::chrono::steady_clock::time_point start);

}  // namespace voxmelt::app
