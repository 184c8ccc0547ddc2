// These faults let vents add too much, or drains leave too much energy. They strike where the treated cell
// shows it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "hwmodel/pipeline/faults/planted.h"
#include "hwmodel/pipeline/model/source_stage.h"

namespace voxmelt::hwmodel {

class SourceFaults : public Planted {
 public:
  using Planted::Planted;
  using Faulty = Source<SourceFaults>;

  void treated(const Faulty& stage, const Cell& in, int lane, Cell& out) {
    const bool cut = stage.came().left > 0 && armed(stage, Fault::tile_vent);
    const bool vents = armed(stage, Fault::vent_rate);
    if (cut) return shift(stage, in, lane, out);
    if (!vents && !armed(stage, Fault::drain_energy)) return;
    Cell wrong = in;
    for (const auto& opening : stage.open_) {
      if (!stage.reaches(opening, lane)) continue;
      if (opening.vent) {
        auto faulty = opening;
        if (vents) faulty.rate = std::min<std::int64_t>(opening.rate + 1, kAmountMax);
        stage.vent(faulty, wrong);
      } else {
        const std::int64_t energy = wrong.energy;
        stage.drain(opening, wrong);
        if (!vents) wrong.energy = std::min<std::int64_t>(energy, wrong.amount + 1);
      }
    }
    wrong.settle_state();
    give(stage, wrong, lane, out);
  }

 private:
  // Places the openings as in a grid that began with the tile.
  void shift(const Faulty& stage, const Cell& in, int lane, Cell& out) {
    Cell wrong = in;
    const int x = stage.came().x - stage.came().left + lane;
    for (const auto& opening : stage.open_)
      if (opening.reach2 >= 0 && stage.covers(opening, x))
        opening.vent ? stage.vent(opening, wrong) : Faulty::drain(opening, wrong);
    wrong.settle_state();
    give(stage, wrong, lane, out);
  }

  void give(const Faulty& stage, const Cell& wrong, int lane, Cell& out) {
    if (wrong == out) return;
    out = wrong;
    strike_lane(stage, stage.came(), lane);
  }
};

}  // namespace voxmelt::hwmodel
