// The folder of a sweep holds its scene, a folder for each run, the table and the page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/runs/design.h"
#include "kernel/run/io/file_lock.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

class SweepFolder {
 public:
  SweepFolder(std::filesystem::path place, const Plan& plan);

  // Writes the scene and what is common to all runs. If they are there already, they must be the same. Throws
  // UsageError.
  void expand(const scene::Scene& scene);
  // Throws UsageError if nobody has expanded it.
  void check_expanded() const;
  // Throws UsageError if another sweep is at work.
  void lock();

  const std::filesystem::path& place() const { return place_; }
  std::filesystem::path run_place(const PlannedRun& run) const { return place_ / "runs" / run.name; }
  std::filesystem::path log_of(const PlannedRun& run) const { return place_ / "logs" / (run.name + ".log"); }

  // Returns the words after "voxmelt" with which a run begins or goes on, in this folder. `more` are options
  // that change no result.
  std::vector<std::string> words_of(const PlannedRun& run, const std::vector<std::string>& more) const;

  // A run is complete, or a living process is at work on it, or neither.
  bool is_complete(const PlannedRun& run) const;
  bool is_at_work(const PlannedRun& run) const;

 private:
  std::string head_text(const scene::Scene& scene) const;
  // Tells if the folder is empty, or holds no more than what a sweep writes first, which was killed then.
  bool has_room(const scene::Scene& scene) const;

  std::filesystem::path place_;
  const Plan& plan_;
  std::string scene_name_;  // of the file in this folder
  io::FileLock lock_;
};

// Returns the program `voxmelt`, which stands beside this one.
std::filesystem::path voxmelt_program();

}  // namespace voxmelt::app
