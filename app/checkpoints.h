// The checkpoints that a run writes into its output folder.
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

// --checkpoint-every: so many steps, or so many seconds ("90s").
struct Interval {
  std::uint32_t steps = 0;  // 0: it counts seconds
  double seconds = 0;
};
// Empty text gives nothing. Throws UsageError.
std::optional<Interval> interval_of(const std::string& text);

class Checkpoints {
 public:
  // Into `folder`, of a run of this scene.
  Checkpoints(std::filesystem::path folder, const scene::Scene& scene, checkpoint::SceneText text,
              int threads);

  // Is it time for one, between two steps?
  bool due(const std::optional<Interval>& interval, std::uint32_t steps_done) const;

  // Those of this run take at most a twentieth of its time, if another one is written now.
  bool affordable() const { return Clock::now() - last_ >= 20 * cost_; }

  // Throws io::OutputError. With `record` as it was before these frames; `seconds` are those of the run so
  // far. Nothing is written where a frame is missing that was due before this step.
  bool write(RunRecord record, Film& film, const run::Simulation& simulation, const Watch::Seen& seen,
             const RunSeconds& seconds);

 private:
  using Clock = std::chrono::steady_clock;
  std::filesystem::path folder_;
  const scene::Scene& scene_;
  checkpoint::SceneText text_;
  int threads_;
  std::vector<checkpoint::FileState> frames_;  // that are known, and on the disk
  Clock::time_point last_ = Clock::now();
  Clock::duration cost_{};  // of the last one
};

}  // namespace voxmelt::app
