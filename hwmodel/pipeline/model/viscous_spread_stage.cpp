#include "hwmodel/pipeline/model/viscous_spread_stage.h"

#include <memory>

#include "hwmodel/pipeline/model/make_stages.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_viscous_spread(const Design& design) {
  return std::make_unique<ViscousSpread<NoFaults>>(design);
}

}  // namespace voxmelt::hwmodel
