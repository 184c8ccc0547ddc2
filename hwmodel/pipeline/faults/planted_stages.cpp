#include "hwmodel/pipeline/faults/planted_stages.h"

#include <memory>

#include "hwmodel/pipeline/faults/apply_faults.h"
#include "hwmodel/pipeline/faults/conduction_faults.h"
#include "hwmodel/pipeline/faults/convection_faults.h"
#include "hwmodel/pipeline/faults/exchange_faults.h"
#include "hwmodel/pipeline/faults/fall_faults.h"
#include "hwmodel/pipeline/faults/gravity_faults.h"
#include "hwmodel/pipeline/faults/melt_faults.h"
#include "hwmodel/pipeline/faults/pattern_faults.h"
#include "hwmodel/pipeline/faults/settle_faults.h"
#include "hwmodel/pipeline/faults/source_faults.h"
#include "hwmodel/pipeline/faults/viscous_spread_faults.h"
#include "hwmodel/pipeline/faults/walls_faults.h"
#include "hwmodel/pipeline/model/conduction_stage.h"
#include "hwmodel/pipeline/model/distant_conduction_stage.h"
#include "hwmodel/pipeline/model/melt_stage.h"

namespace voxmelt::hwmodel {

StageMaker planted_stages(FaultPlan& plan) {
  return [&plan](StageKind kind, const Design& design) -> std::unique_ptr<Stage> {
    using enum StageKind;
    switch (kind) {
      case fall:
        return std::make_unique<FallOfPieces<FallFaults>>(design, FallFaults(plan, design));
      case source:
        return std::make_unique<Source<SourceFaults>>(design, SourceFaults(plan));
      case conduction:
        return std::make_unique<FaceConduction<ConductionFaults>>(design, ConductionFaults(plan));
      case edges:
        return std::make_unique<EdgeConduction<ConductionFaults>>(design, ConductionFaults(plan));
      case corners:
        return std::make_unique<CornerConduction<ConductionFaults>>(design, ConductionFaults(plan));
      case convection:
        return std::make_unique<Convection<ConvectionFaults>>(design, ConvectionFaults(plan));
      case exchange:
        return std::make_unique<Exchange<ExchangeFaults>>(design, ExchangeFaults(plan));
      case melt:
        return std::make_unique<Melt<MeltFaults>>(design, MeltFaults(plan));
      case walls:
        return std::make_unique<Walls<WallsFaults>>(design, WallsFaults(plan));
      case gravity:
        return std::make_unique<Gravity<GravityFaults>>(design, GravityFaults(plan));
      case pattern:
        return std::make_unique<Pattern<PatternFaults>>(design, PatternFaults(plan));
      case apply:
        return std::make_unique<Apply<ApplyFaults>>(design, ApplyFaults(plan));
      case settle:
        return std::make_unique<Settle<SettleFaults>>(design, SettleFaults(plan, design));
      case viscous_spread:
        return std::make_unique<ViscousSpread<ViscousSpreadFaults>>(design, ViscousSpreadFaults(plan));
      default:  // stages without faults
        return make_stage(kind, design);
    }
  };
}

}  // namespace voxmelt::hwmodel
