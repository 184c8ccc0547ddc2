// The functions here find what a run has left that was interrupted, killed, or out of room, and go on with
// it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/run_record.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

struct Resumption {
  scene::Scene scene;  // holds the state from which the run goes on
  checkpoint::SceneText text;
  RunRecord record;
  std::filesystem::path place;               // place of the output
  std::unique_ptr<io::OutputFolder> folder;  // holds the frames that were made, and the checkpoints
  std::string note;                          // why an older checkpoint had to do, or what changed; or empty
};

// Holds the value of --steps for a run that goes on: a number in all, or of further ones ("+2000").
struct StepsWanted {
  std::uint32_t count = 0;
  bool further = false;
};

// Finds the run. `given` is the folder as --out named it, or one beside it (NAME.partial-...,
// NAME.incomplete). `steps` are its new last step. Returns nothing if the run is complete without them.
// Throws UsageError if there is no checkpoint, and checkpoint::Error if none of them is whole.
std::optional<Resumption> find_run(const std::filesystem::path& given,
                                   const std::optional<StepsWanted>& steps = {});

// Lists the checkpoints of an output that is not complete, the newest first. `given` is as for find_run().
std::vector<std::filesystem::path> checkpoints_left(const std::filesystem::path& given);

// Removes the checkpoints of a complete output that stands in its place, and what was kept of this run
// elsewhere.
void clear_after(const std::filesystem::path& place, const std::string& id);

}  // namespace voxmelt::app
