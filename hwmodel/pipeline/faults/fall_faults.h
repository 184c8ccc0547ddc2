// These faults let the wrong cells pass, or lose something as a column turns round.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/faults/planted.h"
#include "hwmodel/pipeline/model/fall_stage.h"

namespace voxmelt::hwmodel {

class FallFaults : public Planted {
 public:
  FallFaults(FaultPlan& plan, const Design& design)
      : Planted(plan), before_(design.shape.lanes), turning_(design.shape.lanes), last_(design.shape.lanes) {}
  using Faulty = FallOfPieces<FallFaults>;

  // `falls` are the bits of the token that comes.
  void judged(const Faulty& stage, const Cell& in, const UInt<1>* falls, int lane, bool& passes) {
    bool wrong = passes;
    if (armed(stage, Fault::fall_not_passed)) wrong = false;
    if (armed(stage, Fault::fall_late)) wrong = before_[lane];
    if (armed(stage, Fault::fall_lane)) wrong = falls[(lane + 1) % stage.lanes()] > 0;
    before_[lane] = passes;
    if (wrong == passes || in.stored() == stage.held_[lane]) return;
    passes = wrong;
    strike_lane(stage, stage.leaving(), lane);
  }

  void turned_round(const Faulty& stage, int lane, bool passes, StoredCell& leaves) {
    if (armed(stage, Fault::fall_below_lost) && !passes && turning_[lane] && leaves != last_[lane]) {
      leaves = last_[lane];
      strike_lane(stage, stage.leaving(), lane);
    }
    if (armed(stage, Fault::fall_heat_stays) && passes && leaves.heat != stage.held_[lane].heat) {
      leaves.heat = stage.held_[lane].heat;
      strike_lane(stage, stage.leaving(), lane);
    }
    if (armed(stage, Fault::fall_material_stays) && passes && leaves.material != stage.held_[lane].material) {
      leaves.material = stage.held_[lane].material;
      strike_lane(stage, stage.leaving(), lane);
    }
    turning_[lane] = passes;
    last_[lane] = leaves;
  }

 private:
  // For each lane: did the token before pass, as it came and as it left; the cell that left before.
  std::vector<std::uint8_t> before_, turning_;
  std::vector<StoredCell> last_;
};

}  // namespace voxmelt::hwmodel
