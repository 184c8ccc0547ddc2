// What a run of the whole machine says: the table, what bounds it, and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "hwmodel/machine/machine.h"

namespace voxmelt::hwmodel {

std::string table_of(const MachineReport& report, const MachineOptions& options);
nlohmann::ordered_json json_of(const MachineReport& report, const MachineOptions& options);

// What keeps the machine from being faster while both of its parts work: the part with the least idle time.
struct Bound {
  std::string name;
  double share = 0;  // of the cycles of the overlapped periods
};
std::vector<Bound> bounds_of(const MachineReport& report, const MachineOptions& options);

}  // namespace voxmelt::hwmodel
