// What a pass moves that no configuration tells: it is counted from the state with which the run begins.
#pragma once

#include <cstdint>

#include "hwmodel/stream/coded_state.h"
#include "hwmodel/stream/irradiance_stream.h"
#include "hwmodel/stream/stage.h"

namespace voxmelt::hwmodel::explore {

struct Content {
  std::int64_t irradiance_bits = 0;  // that a time step reads
  std::int64_t coded_bits = 0;       // of the state with hw.coded, read or written, in whole bursts
};

// Null: there is none.
Content content_of(const Design& design, const Irradiance* irradiance, const state::Volume* volume = nullptr);

}  // namespace voxmelt::hwmodel::explore
