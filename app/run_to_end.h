// A prepared run of `voxmelt run` makes its steps, frames, checkpoints and outputs.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "app/run_record.h"
#include "kernel/run/checkpoint/checkpoint.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

// Holds a run that can begin, or go on.
struct PreparedRun {
  scene::Scene scene;
  checkpoint::SceneText text;
  RunRecord record;
  std::unique_ptr<io::OutputFolder> out;
  std::optional<std::chrono::seconds> wall_clock{};  // for how long it may run
};

// Runs to the end, or to a signal, or until the disk is full. `start` is when the command began. Returns the
// exit code.
int run_to_end(PreparedRun run, std::chrono::steady_clock::time_point start);

}  // namespace voxmelt::app
