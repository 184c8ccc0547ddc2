// These faults keep a hot solid solid, or give fresh liquid too little energy, the material of the solid or
// its heat. Others let liquid freeze that
// is too warm or too little, or do not tell that a cell is set.
#pragma once

#include <algorithm>
#include <cstdint>

#include "hwmodel/pipeline/faults/planted.h"
#include "hwmodel/pipeline/model/melt_stage.h"

namespace voxmelt::hwmodel {

class MeltFaults : public Planted {
 public:
  using Planted::Planted;
  using Faulty = Melt<MeltFaults>;

  void cooled(const Faulty& stage, const Cell& in, int lane, Cell& out) {
    if (!in.liquid() || !stage.design().freezes()) return;
    const bool cold = in.heat < stage.freezes_below_;
    if (!cold && in.heat < stage.curves_.liquid_from(0) && armed(stage, Fault::freeze_warm)) {
      stage.cool(in, out);
    } else if (out.set > 0 && in.touches > 0 && armed(stage, Fault::freeze_film)) {
      Cell full = in;
      full.amount = std::max<std::int64_t>(in.amount, kOne);
      stage.cool(full, out);
    } else if (out.set > 0 && armed(stage, Fault::set_untold)) {
      out.set = 0;
    } else {
      return;
    }
    strike_lane(stage, stage.came(), lane);
  }

  void melted(const Stage& stage, const Cell& in, int lane, Cell& out) {
    if (armed(stage, Fault::melt_stuck))
      out = in;
    else if (armed(stage, Fault::melt_energy) && stage.design().paper())
      out.energy = out.amount - 1;
    else if (armed(stage, Fault::melt_material) && in.material > 0)
      out.material = in.material;
    else if (armed(stage, Fault::melt_heat) && out.heat != in.heat)
      out.heat = in.heat;
    else
      return;
    strike_lane(stage, stage.came(), lane);
  }
};

}  // namespace voxmelt::hwmodel
