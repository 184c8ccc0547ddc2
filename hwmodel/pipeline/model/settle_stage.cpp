#include "hwmodel/pipeline/model/settle_stage.h"

#include <memory>

#include "hwmodel/pipeline/model/make_stages.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_settle(const Design& design) {
  return std::make_unique<Settle<NoFaults>>(design);
}

}  // namespace voxmelt::hwmodel
