// The fault policies of all stages share this class. It tells if their fault is armed, and notes where it
// strikes. A policy takes the place of NoFaults in a stage, and is called at the points named there.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "hwmodel/fabric/tap_line.h"
#include "hwmodel/pipeline/faults/faults.h"
#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

class Planted : public check::Planted<FaultPlan> {
 public:
  using check::Planted<FaultPlan>::Planted;

 protected:
  // Beside a cut, a tile computes cells that another tile owns, and some of them it spoils. A fault strikes
  // only where the tile owns all that it could change, because only owned cells are compared.
  bool armed(const Stage& stage, Fault fault) const {
    return plan().armed(fault, stage.working_step()) && deep_within(stage);
  }

  // Strikes. The first cell that leaves the stage wrong is at x, y, z.
  void strike(const Stage& stage, int x, int y, int z) {
    plan().strike({stage.name(), stage.working_step(), x, y, z});
  }
  // Strikes likewise. The wrong cell is in this lane of a token.
  void strike_lane(const Stage& stage, const Place& place, int lane) {
    strike(stage, place.x + lane, place.y, place.z);
  }
  // Strikes likewise. A word of the stage's line holds the wrong cell. If there are two, the one that leaves
  // first counts.
  template <class Word>
  void strike_word(const Stage& stage, TapLine<Word>& line, const Word& word) {
    const auto [age, lane] = position_of(stage, line, word);
    strike_lane(stage, stage.place_at(-age), lane);
  }
  template <class Word>
  void strike_first_word(const Stage& stage, TapLine<Word>& line, const Word& one, const Word& other) {
    const auto [age, lane] = std::min(position_of(stage, line, one), position_of(stage, line, other));
    strike_lane(stage, stage.place_at(-age), lane);
  }

  // Lets a cell at the end of the grid leave without the bit that it stands beside a wall.
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
  static bool deep_within(const Stage& stage) {
    const Shape& shape = stage.shape();
    if (!shape.tiled()) return true;
    const int tile = stage.tile_at(stage.spot_delay()), x = stage.spot().token.x, end = x + shape.lanes;
    return shape.owns(tile, x) && (x == 0 || shape.owns(tile, x - 1)) &&
           (end >= shape.grid.x || shape.owns(tile, end));
  }

  // Returns where a word is in the stream: its age in shifts with a minus sign, and its lane. A word that
  // leaves first is less.
  template <class Word>
  static std::pair<std::int64_t, int> position_of(const Stage& stage, TapLine<Word>& line, const Word& word) {
    std::size_t delay = 0;
    while (&word < line.tap(delay) || &word >= line.tap(delay) + stage.lanes()) ++delay;
    return {-static_cast<std::int64_t>(delay), &word - line.tap(delay)};
  }
};

}  // namespace voxmelt::hwmodel
