// The stages of the phases source, heat and melt, as make_step puts them together.
#pragma once

#include "tests/hwmodel/phase_world.h"

namespace voxmelt::hwmodel {

inline void source_of(const Design& design, Stages& stages, FedStage*&) {
  if (!design.parameters.vents.empty() || !design.parameters.drains.empty())
    stages.push_back(make_source(design));
}

inline void heat_of(const Design& design, Stages& stages, FedStage*& fed) {
  const rule::Heat& heat = design.parameters.heat;
  if (!heat.enabled) return;
  stages.push_back(make_conduction(design));
  if (heat.neighbours >= 18) stages.push_back(make_edge_conduction(design));
  if (heat.neighbours >= 26) stages.push_back(make_corner_conduction(design));
  if (heat.convection > 0) stages.push_back(make_convection(design));
  if (!heat.radiation && !heat.air) return;
  std::unique_ptr<FedStage> exchange = make_exchange(design);
  if (heat.radiation) fed = exchange.get();
  stages.push_back(std::move(exchange));
}

inline void melt_of(const Design& design, Stages& stages, FedStage*&) {
  if (design.hot()) stages.push_back(make_melt(design));
}

}  // namespace voxmelt::hwmodel
