
#include "hwmodel/pipeline/model/stages.h"

#include <stdexcept>
#include <string>

#include "hwmodel/pipeline/model/make_stages.h"

namespace voxmelt::hwmodel {

std::vector<StageKind> stages_of_step(const Design& design) {
  using enum StageKind;
  std::vector<StageKind> stages;
  const auto add = [&](StageKind kind) { stages.push_back(kind); };
  const rule::Parameters& parameters = design.parameters;
  const rule::Heat& heat = parameters.heat;

  if (parameters.pieces.fall) add(fall);
  if (parameters.has_openings()) add(source);
  if (design.hot()) {
    add(conduction);
    if (heat.neighbours >= 18) add(edges);
    if (heat.neighbours >= 26) add(corners);
    if (heat.convection > 0) add(convection);
    if (heat.radiation || heat.air) add(exchange);
    add(melt);
  }
  if (design.paper()) {
    if (design.needs_walls() && !design.walls_in_conduction()) add(walls);
    add(gravity);
    add(pattern);
    add(apply);
  } else {
    for (int copy = 0; copy < design.substeps; ++copy) {
      add(settle);
      add(viscous_spread);
    }
    add(gravity);
  }
  return stages;
}

std::unique_ptr<Stage> make_stage(StageKind kind, const Design& design) {
  using enum StageKind;
  switch (kind) {
    case fall:
      return make_fall(design);
    case source:
      return make_source(design);
    case conduction:
      return make_conduction(design);
    case edges:
      return make_edge_conduction(design);
    case corners:
      return make_corner_conduction(design);
    case convection:
      return make_convection(design);
    case exchange:
      return make_exchange(design);
    case melt:
      return make_melt(design);
    case walls:
      return make_walls(design);
    case gravity:
      return make_gravity(design);
    case pattern:
      return make_pattern(design);
    case apply:
      return make_apply(design);
    case settle:
      return make_settle(design);
    case viscous_spread:
      return make_viscous_spread(design);
    case reader:
    case feed:
    case fall_feed:
    case writer:
      break;
  }
  throw std::logic_error(std::string(name_of(kind)) + " is no stage of a time step");
}

Stages make_step(const Design& design, const StageMaker& make) {
  Stages stages;
  for (const StageKind kind : stages_of_step(design)) stages.push_back(make(kind, design));
  return stages;
}

}  // namespace voxmelt::hwmodel
