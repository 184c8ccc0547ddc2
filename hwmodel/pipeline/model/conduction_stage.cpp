#include "hwmodel/pipeline/model/conduction_stage.h"

#include <memory>

#include "hwmodel/pipeline/model/make_stages.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_conduction(const Design& design) {
  return std::make_unique<FaceConduction<NoFaults>>(design);
}

}  // namespace voxmelt::hwmodel
