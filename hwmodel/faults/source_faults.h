// Vents that add too much, drains that leave too much energy: strikes where the treated cell shows it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "hwmodel/faults/planted.h"
#include "hwmodel/stream/source_stage.h"

namespace voxmelt::hwmodel {

class SourceFaults : public Planted {
 public:
  using Planted::Planted;
  using Faulty = Source<SourceFaults>;

  void treated(const Faulty& stage, const Cell& in, int lane, Cell& out) {
    const bool vents = armed(stage, Fault::vent_rate);
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
    if (wrong == out) return;
    out = wrong;
    strike_lane(stage, stage.came(), lane);
  }
};

}  // namespace voxmelt::hwmodel
