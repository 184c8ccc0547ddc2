#include <utility>

#include "hwmodel/stream/stages.h"

namespace voxmelt::hwmodel {

StepStages make_step(const Design& design) {
  StepStages step;
  const auto add = [&](std::unique_ptr<Stage> stage) { step.stages.push_back(std::move(stage)); };
  const rule::Parameters& parameters = design.parameters;
  const rule::Heat& heat = parameters.heat;

  if (!parameters.vents.empty() || !parameters.drains.empty()) add(make_source(design));
  if (design.hot()) {
    add(make_conduction(design));
    if (heat.neighbours >= 18) add(make_edge_conduction(design));
    if (heat.neighbours >= 26) add(make_corner_conduction(design));
    if (heat.convection > 0) add(make_convection(design));
    if (heat.radiation || heat.air) {
      std::unique_ptr<FedStage> exchange = make_exchange(design);
      if (heat.radiation) step.fed = exchange.get();
      add(std::move(exchange));
    }
    add(make_melt(design));
  }
  if (design.paper()) {
    if (design.needs_walls() && !design.walls_in_conduction()) add(make_walls(design));
    add(make_gravity(design));
    add(make_pattern(design));
    add(make_apply(design));
  } else {
    add(make_settle(design));
    add(make_viscous_spread(design));
    add(make_gravity(design));
  }
  return step;
}

}  // namespace voxmelt::hwmodel
