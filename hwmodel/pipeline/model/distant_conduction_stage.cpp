#include "hwmodel/pipeline/model/distant_conduction_stage.h"

#include <memory>

#include "hwmodel/pipeline/model/make_stages.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_edge_conduction(const Design& design) {
  return std::make_unique<EdgeConduction<NoFaults>>(design);
}

std::unique_ptr<Stage> make_corner_conduction(const Design& design) {
  return std::make_unique<CornerConduction<NoFaults>>(design);
}

}  // namespace voxmelt::hwmodel
