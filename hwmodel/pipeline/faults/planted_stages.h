// The stages in which faults are planted.
#pragma once

#include "hwmodel/pipeline/faults/faults.h"
#include "hwmodel/pipeline/model/stages.h"

namespace voxmelt::hwmodel {

// Makes stages that all heed `plan`, which must outlive them.
StageMaker planted_stages(FaultPlan& plan);

}  // namespace voxmelt::hwmodel
