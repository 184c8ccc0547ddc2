// The stages in which faults are planted.
#pragma once

#include "hwmodel/faults/faults.h"
#include "hwmodel/stream/stages.h"

namespace voxmelt::hwmodel {

// Makes stages that all heed `plan`, which must outlive them.
StageMaker planted_stages(FaultPlan& plan);

}  // namespace voxmelt::hwmodel
