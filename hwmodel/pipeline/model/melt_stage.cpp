#include "hwmodel/pipeline/model/melt_stage.h"

#include <memory>

#include "hwmodel/pipeline/model/make_stages.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_melt(const Design& design) { return std::make_unique<Melt<NoFaults>>(design); }

}  // namespace voxmelt::hwmodel
