#include "hwmodel/pipeline/model/apply_stage.h"

#include <memory>

#include "hwmodel/pipeline/model/make_stages.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_apply(const Design& design) { return std::make_unique<Apply<NoFaults>>(design); }

}  // namespace voxmelt::hwmodel
