// These faults open directions that should not be open, let a set cell choose some, or use the random byte of
// the next cell.
#pragma once

#include <cstdint>
#include <map>

#include "hwmodel/pipeline/faults/planted.h"
#include "hwmodel/pipeline/model/pattern_stage.h"

namespace voxmelt::hwmodel {

class PatternFaults : public Planted {
 public:
  using Planted::Planted;
  using Faulty = Pattern<PatternFaults>;

  // `stands` tells if the cell could give, were it not set.
  void allowed(const Faulty& stage, bool stands, Giver& giver) const {
    if (stands && giver.set > 0 && armed(stage, Fault::pattern_set_gives)) stage.allow(giver);
  }

  void offered(const Faulty& stage, const Giver& giver, Way way, const Giver& other, std::int64_t limit,
               bool open) {
    const bool between_walls = !open && other.amount < limit;
    const bool as_high = open && limit > 0 && other.amount >= limit && other.amount <= giver.amount &&
                         other.amount < stage.flow_.limit();
    if ((between_walls && armed(stage, Fault::pattern_diagonal_open)) ||
        (as_high && armed(stage, Fault::pattern_margin)))
      wrongly_open_[&giver] |= 1 << way;
  }

  void drawn(const Faulty& stage, const Giver& word, int lane, Cell& cell) {
    std::int64_t wrong = cell.pattern;
    if (armed(stage, Fault::pattern_random_lane))
      wrong = word.pattern & random_byte(stage, lane, 1);
    else if (stage.leaving().left > 0 && armed(stage, Fault::tile_coordinate))
      wrong = word.pattern & random_byte(stage, lane - stage.leaving().left, 0);
    else if (armed(stage, Fault::pattern_diagonal_open) || armed(stage, Fault::pattern_margin))
      wrong |= lowest_bit(wrongly_open_[&word] & random_byte(stage, lane, 0));
    wrongly_open_.erase(&word);
    if (word.set > 0 && cell.pattern != 0 && !plan().struck())
      return strike_lane(stage, stage.leaving(), lane);
    if (wrong == cell.pattern) return;
    cell.pattern = wrong;
    strike_lane(stage, stage.leaving(), lane);
  }

 private:
  static std::int64_t lowest_bit(std::int64_t bits) { return bits & -bits; }

  // Returns the random byte of the cell that is `further` along x from the one that leaves. It comes from the
  // block of the latter.
  static std::int64_t random_byte(const Faulty& stage, int lane, int further) {
    const int x = stage.leaving().x + lane;
    return speck_byte(speck_block(stage.keys_, stage.step_at(stage.lag()), stage.block_index(x)),
                      x + further);
  }

  std::map<const Giver*, std::int64_t> wrongly_open_;  // directions of the words that wait in the line
};

}  // namespace voxmelt::hwmodel
