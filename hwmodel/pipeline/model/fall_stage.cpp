#include "hwmodel/pipeline/model/fall_stage.h"

#include <memory>

#include "hwmodel/pipeline/model/make_stages.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_fall(const Design& design) {
  return std::make_unique<FallOfPieces<NoFaults>>(design);
}

}  // namespace voxmelt::hwmodel
