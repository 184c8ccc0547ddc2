#include "hwmodel/pipeline/model/gravity_stage.h"

#include <memory>

#include "hwmodel/pipeline/model/make_stages.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_gravity(const Design& design) {
  return std::make_unique<Gravity<NoFaults>>(design);
}

}  // namespace voxmelt::hwmodel
