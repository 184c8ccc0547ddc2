#include "hwmodel/pipeline/model/source_stage.h"

#include <memory>

#include "hwmodel/pipeline/model/make_stages.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_source(const Design& design) {
  return std::make_unique<Source<NoFaults>>(design);
}

}  // namespace voxmelt::hwmodel
