// Pipes of the ray caster can be made with faults planted in them.
#pragma once

#include "hwmodel/caster/faults/faults.h"
#include "hwmodel/caster/model/pipe.h"

namespace voxmelt::hwmodel::raycast {

// Makes pipes that all heed `plan`, which must outlive them.
PipeMaker planted_pipes(FaultPlan& plan);

}  // namespace voxmelt::hwmodel::raycast
