#include "hwmodel/stream/apply_stage.h"

#include <memory>

#include "hwmodel/stream/make_stages.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_apply(const Design& design) { return std::make_unique<Apply<NoFaults>>(design); }

}  // namespace voxmelt::hwmodel
