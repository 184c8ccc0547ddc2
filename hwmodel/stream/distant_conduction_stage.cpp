// Conduction with 18 or 26 neighbours: a pass for those across an edge, another for those across a corner.
#include <memory>

#include "hwmodel/stream/conduction_pass.h"
#include "hwmodel/stream/stages.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_edge_conduction(const Design& design) {
  const rule::Heat& heat = design.parameters.heat;
  return std::make_unique<ConductionPass<kEdgePairs>>("edges", design, heat.weight_edge,
                                                      heat.neighbours < 26);
}

std::unique_ptr<Stage> make_corner_conduction(const Design& design) {
  return std::make_unique<ConductionPass<kCornerPairs>>("corners", design,
                                                        design.parameters.heat.weight_corner, true);
}

}  // namespace voxmelt::hwmodel
