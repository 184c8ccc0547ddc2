// A run writes these checkpoints into its output folder.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/film.h"
#include "app/run_record.h"

namespace voxmelt::app {

// Holds the value of --checkpoint-every: a number of steps, or of seconds ("90s").
struct Interval {
  std::uint32_t steps = 0;  // 0 if the interval is in seconds
  double seconds = 0;
};
// Reads an interval. Empty text gives none. Throws UsageError.
std::optional<Interval> interval_of(const std::string& text);

class Checkpoints {
 public:
  // Writes into `folder`, for a run of this scene.
  Checkpoints(std::filesystem::path folder, const scene::Scene& scene, checkpoint::SceneText text,
              int threads);

  // Later checkpoints have other settings of the scene (TOML), and the scene's present parameters.
  void change_settings(std::string settings, state::Grid grid);

  // Tells if it is time for a checkpoint, between two steps.
  bool due(const std::optional<Interval>& interval, std::uint32_t steps_done) const;

  // Tells if the checkpoints of this run take at most a twentieth of its time when another one is written
  // now.
  bool affordable() const { return Clock::now() - last_ >= 20 * cost_; }

  // Writes a checkpoint. `record` is as it was before these frames, and `seconds` are those of the run so
  // far. Nothing is written if a frame is missing that was due before this step. Throws io::OutputError.
  bool write(RunRecord record, Film& film, const run::Simulation& simulation, const Watch::Seen& seen,
             const RunSeconds& seconds);

  // Writes the last state of a complete run, from which more steps can follow. Throws io::OutputError.
  void write_last(RunRecord record, Film& film, const run::Simulation& simulation, const Watch::Seen& seen,
                  const RunSeconds& seconds);

 private:
  void write_to(const std::filesystem::path& file, RunRecord record, const run::Simulation& simulation,
                const Watch::Seen& seen, const RunSeconds& seconds);

  using Clock = std::chrono::steady_clock;
  std::filesystem::path folder_;
  const scene::Scene& scene_;
  checkpoint::SceneText text_;
  int threads_;
  std::vector<checkpoint::FileState> frames_;  // frames that are known, and on the disk
  Clock::time_point last_ = Clock::now();
  Clock::duration cost_{};  // time that the last one took
};

}  // namespace voxmelt::app
