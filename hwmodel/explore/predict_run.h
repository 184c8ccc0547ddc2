// What the closed form of a DRAM says of a run that was verified on one.
#pragma once

#include "hwmodel/memory/chosen_memory.h"
#include "hwmodel/pipeline/check/verify.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::hwmodel::explore {

// Adds to the report what the memory moves at most, and to each train what the closed form predicts: for a
// run that moves what `start`, the state at its begin, and its irradiance (null: dark) hold. Where the state
// decides on sub-steps, no train has a prediction.
void predict_on_memory(VerifyReport& report, const Design& design, const Configuration& configuration,
                       const memory::Choice& memory, const state::Volume& start,
                       const Irradiance* irradiance);

}  // namespace voxmelt::hwmodel::explore
