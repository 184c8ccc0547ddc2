#include "hwmodel/pipeline/model/exchange_stage.h"

#include <memory>

#include "hwmodel/pipeline/model/make_stages.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_exchange(const Design& design) {
  return std::make_unique<Exchange<NoFaults>>(design);
}

}  // namespace voxmelt::hwmodel
