// Conduction with 18 or 26 neighbours has a pass for those across an edge, and another for those across a
// corner.
#pragma once

#include "hwmodel/pipeline/model/conduction_pass.h"

namespace voxmelt::hwmodel {

template <class Faults>
class EdgeConduction final : public ConductionPass<kEdgePairs, Faults> {
 public:
  explicit EdgeConduction(const Design& design, Faults faults = {})
      : ConductionPass<kEdgePairs, Faults>(
            StageKind::edges, design,
            {design.parameters, design.parameters.heat.weight_edge, &rule::SolidMaterial::weight_edge},
            faults) {}
};

template <class Faults>
class CornerConduction final : public ConductionPass<kCornerPairs, Faults> {
 public:
  explicit CornerConduction(const Design& design, Faults faults = {})
      : ConductionPass<kCornerPairs, Faults>(
            StageKind::corners, design,
            {design.parameters, design.parameters.heat.weight_corner, &rule::SolidMaterial::weight_corner},
            faults) {}
};

}  // namespace voxmelt::hwmodel
