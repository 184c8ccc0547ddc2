// The stages are made with faults planted in them.
#pragma once

#include "hwmodel/pipeline/faults/faults.h"
#include "hwmodel/pipeline/model/stages.h"

namespace voxmelt::hwmodel {

// Makes stages that all follow `plan`, which must outlive them.
StageMaker planted_stages(FaultPlan& plan);

}  // namespace voxmelt::hwmodel
