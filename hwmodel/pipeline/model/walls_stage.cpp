#include "hwmodel/pipeline/model/walls_stage.h"

#include <memory>

#include "hwmodel/pipeline/model/make_stages.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_walls(const Design& design) { return std::make_unique<Walls<NoFaults>>(design); }

}  // namespace voxmelt::hwmodel
