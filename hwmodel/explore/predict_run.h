// The closed form of a DRAM predicts a run that was verified on one.
#pragma once

#include "hwmodel/memory/chosen_memory.h"
#include "hwmodel/pipeline/check/verify.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::hwmodel::explore {

// Adds to the report how much the memory moves at most, and to each train the cycles that the closed form
// predicts. The run is taken to move what `start`, the state at its beginning, and its irradiance hold (null:
// dark).
void predict_on_memory(VerifyReport& report, const Design& design, const Configuration& configuration,
                       const memory::Choice& memory, const state::Volume& start,
                       const Irradiance* irradiance);

}  // namespace voxmelt::hwmodel::explore
