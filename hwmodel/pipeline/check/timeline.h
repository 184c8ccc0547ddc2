// A timeline tells what every stage did when. It keeps the accounts of all stages at the ends of equal
// stretches of the run. A run may have any length: when there are too many stretches, two become one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

class Timeline {
 public:
  static constexpr std::size_t kMost = 128;  // stretches

  // `cycles` of the run are over. Returns true when the accounts are wanted now.
  bool wants(std::int64_t cycles) const { return cycles % width_ == 0; }
  void add(std::vector<StageCycles> accounts);
  void end(std::vector<StageCycles> accounts);  // the last stretch may be shorter

  std::int64_t width() const { return width_; }  // cycles of a stretch
  std::size_t stretches() const { return ends_.size(); }
  std::int64_t cycles() const {
    return ends_.empty() ? 0 : ends_.back().front().total();
  }  // cycles of all stretches
  // Returns what a stage did within a stretch.
  StageCycles within(std::size_t stretch, std::size_t stage) const;

 private:
  std::int64_t width_ = 1;
  std::vector<std::vector<StageCycles>> ends_;  // accounts of all stages, since the begin of the run
};

}  // namespace voxmelt::hwmodel
