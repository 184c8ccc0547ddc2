#include "hwmodel/pipeline/model/convection_stage.h"

#include <memory>

#include "hwmodel/pipeline/model/make_stages.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_convection(const Design& design) {
  return std::make_unique<Convection<NoFaults>>(design);
}

}  // namespace voxmelt::hwmodel
