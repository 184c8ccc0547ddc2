// Finds what a run that was interrupted, killed, or out of room has left, and goes on with it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/run_record.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

struct Resumption {
  scene::Scene scene;  // with what a run goes on from
  checkpoint::SceneText text;
  RunRecord record;
  std::filesystem::path place;               // of the output
  std::unique_ptr<io::OutputFolder> folder;  // with the frames that were made, and the checkpoints
  std::string note;                          // why an older checkpoint had to do, or what changed; or empty
};

// `given` is the folder as --out named it, or what stands beside it (NAME.partial-..., NAME.incomplete).
// Nothing where the run is complete. Throws UsageError where there is no checkpoint, checkpoint::Error where
// none of them is whole.
std::optional<Resumption> find_run(const std::filesystem::path& given);

// After the output stands in its place, complete: removes its checkpoints, and what was kept of this run
// elsewhere.
void clear_after(const std::filesystem::path& place, const std::string& id);

}  // namespace voxmelt::app
