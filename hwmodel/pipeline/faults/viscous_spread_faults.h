// These faults spoil the flows of the viscous spread. A flow moves inside the dead zone, between shut runs or
// out of a set cell, or uses the dither of the next axis, sub-step or layer. It flows as on a level bed, or
// on one that is level across, by the giver's amount alone, or is lost on its way. Others let cells leave
// without their side bands.
#pragma once

#include <cstdint>

#include "hwmodel/pipeline/faults/planted.h"
#include "hwmodel/pipeline/model/viscous_spread_stage.h"

namespace voxmelt::hwmodel {

class ViscousSpreadFaults : public Planted {
 public:
  using Planted::Planted;
  using Faulty = ViscousSpread<ViscousSpreadFaults>;

  void wanted(Faulty& stage, const SeenCell& from, const SeenCell& to, const SpreadPair& pair,
              UInt<16>& amount) {
    const int axis = pair.axis;
    const bool closed = stage.closed(from, to), dead = stage.in_dead_zone(from, to, axis);
    const bool set = from.word->set > 0, rests = closed || dead || set;
    UInt<16> wrong = amount;
    if ((set && !closed && !dead && armed(stage, Fault::viscous_set_gives)) ||
        (dead && !closed && !set && armed(stage, Fault::viscous_dead_zone)) ||
        (closed && !dead && !set && armed(stage, Fault::viscous_shut)))
      wrong = stage.wanted(from, to, pair, stage.dither_of_axis(axis));
    if (!rests && armed(stage, Fault::viscous_dither))
      wrong = stage.wanted(from, to, pair, stage.dither_of_axis((axis + 1) % 4));
    if (!rests && armed(stage, Fault::viscous_substep))
      wrong = stage.wanted(from, to, pair, dither(stage, axis, 0, 1));
    if (!rests && armed(stage, Fault::viscous_layer))
      wrong = stage.wanted(from, to, pair, dither(stage, axis, 1, 0));
    if (!rests && armed(stage, Fault::viscous_slope)) {
      SeenCell level = from;
      level.bed = to.bed;
      wrong = stage.wanted(level, to, {axis, 0, pair.blocked_beside}, stage.dither_of_axis(axis));
    }
    if (!rests && armed(stage, Fault::viscous_across))
      wrong = stage.wanted(from, to, {axis, 0, pair.blocked_beside}, stage.dither_of_axis(axis));
    if (!rests && armed(stage, Fault::viscous_mean) && from.bed == to.bed) {
      SeenCell without_bed = to;  // the factor of the slope is that of a level bed, too
      without_bed.bed = kNoBed;
      wrong = stage.wanted(from, without_bed, pair, stage.dither_of_axis(axis));
    }
    if (wrong == amount) return;
    amount = wrong;
    strike_first_word(stage, stage.line_, *from.word, *to.word);
  }

  void moved(Faulty& stage, const SeenCell& from, const SeenCell& to, std::int64_t amount) {
    if (!armed(stage, Fault::viscous_flow_lost)) return;
    to.word->present = to.word->present - amount;
    if (stage.hot_) to.word->content = to.word->content - amount * from.word->heat;
    strike_word(stage, stage.line_, *to.word);
  }

  void gave(const Faulty& stage, int lane, Cell& cell) {
    miss_side(stage, Fault::viscous_side_missed, lane, cell);
    if (cell.in_run == 0 || !armed(stage, Fault::viscous_run_forgotten)) return;
    cell.in_run = 0;
    strike_lane(stage, stage.leaving(), lane);
  }

 private:
  // Returns the dither `up` layers above and `later` sub-steps later.
  static std::int64_t dither(const Faulty& stage, int axis, int up, int later) {
    const std::int64_t layer = dither_of(stage.came().y + up);
    return stage.pair_dither(axis, layer, stage.moment().substep + later);
  }
};

}  // namespace voxmelt::hwmodel
