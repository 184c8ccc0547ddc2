// One design is sought for several scenes. Each scene has the stages of its own rule, and tiles of its own:
// what they share are lanes, steps, sub-steps, depth, overlap, code and clock. It has to fit for all of them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hwmodel/explore/check.h"
#include "hwmodel/explore/sweep.h"

namespace voxmelt::hwmodel::explore {

struct BatchScene {
  std::string name;
  const Question& question;
  const Swept& swept;
};

// Is a design for all scenes: of each, the point with these numbers that is the fastest of those that fit.
struct BatchDesign {
  Configuration hw;  // hw.tile means nothing
  int clock_mhz = 0;
  std::vector<std::size_t> points;  // into Swept::points of each scene
  double seconds = 0;               // sum over all scenes
  double worst_share = 1;           // least speed, as a share of the scene's own best one
  std::size_t worst = 0;            // the scene with it
};

enum class Aim { sum, worst };  // the least sum of times, or the greatest of the worst shares

struct Batch {
  std::vector<std::optional<std::size_t>> own;  // the best point of each scene alone; none if nothing fits
  double own_seconds = 0;                       // sum of the times that these take
  std::vector<BatchDesign> designs;             // that fit for all, the best first
};

double seconds_of(const Question& question, const Point& point);
Batch batch_of(const std::vector<BatchScene>& scenes, Aim aim);

// Points of the best design that were simulated, one for each scene; empty: none was.
std::string batch_text(const std::vector<BatchScene>& scenes, const Batch& batch, Aim aim,
                       const std::vector<Checked>& checked);
std::string batch_csv(const std::vector<BatchScene>& scenes, const Batch& batch);
std::string batch_json(const std::vector<BatchScene>& scenes, const Batch& batch, Aim aim,
                       const std::vector<Checked>& checked);

}  // namespace voxmelt::hwmodel::explore
