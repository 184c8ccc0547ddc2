// A diagnosis tells what is wrong with a train of passes as a whole: it hangs, or it takes the wrong number
// of cycles.
#pragma once

#include <cstdint>

#include "hwmodel/pipeline/check/mismatch.h"
#include "hwmodel/pipeline/model/stream_machine.h"

namespace voxmelt::hwmodel {

// Finds where everything waits: the channel behind the last full one, and the cell that should enter it.
Mismatch hang_of(const StreamMachine& machine, const Pass& first, std::int64_t cycle);

// Reports a train in which nothing stalled, and which took other cycles than the closed form says.
Mismatch cycles_of(const StreamMachine& machine, std::uint32_t first_step, std::int64_t predicted,
                   std::int64_t cycles);

}  // namespace voxmelt::hwmodel
