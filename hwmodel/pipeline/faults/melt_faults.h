// These faults keep a hot solid solid, or give fresh liquid too little energy.
#pragma once

#include "hwmodel/pipeline/faults/planted.h"

namespace voxmelt::hwmodel {

class MeltFaults : public Planted {
 public:
  using Planted::Planted;

  void melted(const Stage& stage, const Cell& in, int lane, Cell& out) {
    if (armed(stage, Fault::melt_stuck))
      out = in;
    else if (armed(stage, Fault::melt_energy) && stage.design().paper())
      out.energy = out.amount - 1;
    else
      return;
    strike_lane(stage, stage.came(), lane);
  }
};

}  // namespace voxmelt::hwmodel
