#include "hwmodel/stream/pattern_stage.h"

#include <memory>

#include "hwmodel/stream/make_stages.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_pattern(const Design& design) {
  return std::make_unique<Pattern<NoFaults>>(design);
}

}  // namespace voxmelt::hwmodel
