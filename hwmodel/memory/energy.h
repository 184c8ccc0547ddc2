// The energy of a DRAM follows from the currents of its data sheet and from what it did (Micron TN-40-07;
// Chandrasekar et al., DRAMPower). Currents of a sheet are what its maker promises not to exceed, so this is
// more than a part takes. Pins and their termination are not in it, nor is any state of power down.
#pragma once

#include "hwmodel/memory/counts.h"
#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel::memory {

// All are nanojoules. The commands' parts come on top of standby.
struct Energy {
  double activate = 0;  // opens and closes rows
  double read = 0, write = 0, refresh = 0;
  double background = 0;  // standby
  double all() const { return activate + read + write + refresh + background; }
};

// Returns 0 for a sheet without currents.
Energy energy_of(const Counts& counts, const Parameters& parameters);

// Returns the time of these counts in ns.
double nanoseconds_of(const Counts& counts, const Parameters& parameters);

// Returns the mean current of standby over the tRC of one row.
double standby_of_a_row(const Rail& rail, const Parameters& parameters);

}  // namespace voxmelt::hwmodel::memory
