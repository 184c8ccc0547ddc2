// This fault lets heat rise into the warmer cell.
#pragma once

#include <cstdint>

#include "hwmodel/pipeline/faults/heat_survival.h"
#include "hwmodel/pipeline/faults/planted.h"
#include "hwmodel/pipeline/model/convection_stage.h"

namespace voxmelt::hwmodel {

class ConvectionFaults : public Planted {
 public:
  using Planted::Planted;
  using Faulty = Convection<ConvectionFaults>;

  void rested(Faulty& stage, HeatWord& below, HeatWord& above) {
    if (!armed(stage, Fault::convection_downwards)) return;
    const std::int64_t rise = std::int64_t{above.temperature} - below.temperature;
    const std::int64_t flow = scale(rise, stage.weight_, stage.dither_), left = below.heat - flow;
    if (flow == 0 || left < 0 || above.heat + flow > kHeatMax) return;
    if (!survives_exchange(stage.design().parameters.heat, below, below.heat, left)) return;
    stage.move(below, above, flow);
    strike_word(stage, stage.line_, below);
  }
};

}  // namespace voxmelt::hwmodel
