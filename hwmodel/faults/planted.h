// What the fault policies of all stages share: is their fault armed, and where did it strike? Such a policy
// takes the place of NoFaults in a stage, and is called at the points named there.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hwmodel/channel/tap_line.h"
#include "hwmodel/faults/faults.h"
#include "hwmodel/stream/stage.h"

namespace voxmelt::hwmodel {

class Planted {
 public:
  explicit Planted(FaultPlan& plan) : plan_(&plan) {}

 protected:
  bool armed(const Stage& stage, Fault fault) const { return plan_->armed(fault, stage.working_step()); }

  // The fault strikes; the first cell that leaves the stage wrong is the one at x, y, z ...
  void strike(const Stage& stage, int x, int y, int z) {
    plan_->strike({stage.name(), stage.working_step(), x, y, z});
  }
  // ... in this lane of a token ...
  void strike_lane(const Stage& stage, const Place& place, int lane) {
    strike(stage, place.x + lane, place.y, place.z);
  }
  // ... or the one that a word of the stage's line holds, of two the one that leaves first.
  template <class Word>
  void strike_word(const Stage& stage, TapLine<Word>& line, const Word& word) {
    strike_at(stage, position_of(stage, line, word));
  }
  template <class Word>
  void strike_first_word(const Stage& stage, TapLine<Word>& line, const Word& one, const Word& other) {
    strike_at(stage, std::min(position_of(stage, line, one), position_of(stage, line, other)));
  }

  // A cell at the end of the grid leaves without the bit that it stands beside a wall.
  void miss_side(const Stage& stage, Fault fault, int lane, Cell& cell) {
    if (!armed(stage, fault) || cell.beside_wall == 0 || !cell.matter()) return;
    const Place& at = stage.leaving();
    const state::Grid& grid = stage.shape().grid;
    const int x = at.x + lane;
    if (x > 0 && x < grid.x - 1 && at.z > 0 && at.z < grid.z - 1) return;
    if (x >= grid.x) return;
    cell.beside_wall = 0;
    strike_lane(stage, at, lane);
  }

 private:
  // The position of a word in the stream of its pass, in cells.
  template <class Word>
  static std::int64_t position_of(const Stage& stage, TapLine<Word>& line, const Word& word) {
    std::size_t delay = 0;
    while (&word < line.tap(delay) || &word >= line.tap(delay) + stage.lanes()) ++delay;
    std::int64_t ordinal = stage.came().ordinal - static_cast<std::int64_t>(delay);
    if (ordinal < 0) ordinal += stage.shape().tokens();  // of the last pass
    return ordinal * stage.lanes() + (&word - line.tap(delay));
  }
  void strike_at(const Stage& stage, std::int64_t position) {
    strike_lane(stage, place_of(stage.shape(), position / stage.lanes()),
                static_cast<int>(position % stage.lanes()));
  }

  FaultPlan* plan_;
};

}  // namespace voxmelt::hwmodel
