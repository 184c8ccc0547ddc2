#include "hwmodel/pipeline/model/pattern_stage.h"

#include <memory>

#include "hwmodel/pipeline/model/make_stages.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_pattern(const Design& design) {
  return std::make_unique<Pattern<NoFaults>>(design);
}

}  // namespace voxmelt::hwmodel
