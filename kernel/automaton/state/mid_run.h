// A run between two steps has this state beside parameters and volume. The next steps depend on it, and
// reports of the earlier steps need it.
#pragma once

#include <cstdint>

#include "kernel/automaton/state/field.h"
#include "kernel/automaton/state/ledger.h"
#include "kernel/automaton/state/seconds.h"

namespace voxmelt::state {

struct MidRun {
  std::uint32_t steps_done = 0;
  Ledger ledger;
  Field<std::uint16_t> irradiance;     // from the last step of visibility; empty without radiation
  std::int64_t irradiance_capped = 0;  // number of times that a cell was cut
  std::int64_t rays = 0, rays_cast = 0;
  Seconds seconds;
};

}  // namespace voxmelt::state
