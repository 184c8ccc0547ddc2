// The report of the whole machine is a table, the parts that bound its speed, and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "hwmodel/machine/machine.h"

namespace voxmelt::hwmodel {

std::string table_of(const MachineReport& report, const MachineOptions& options);
nlohmann::ordered_json json_of(const MachineReport& report, const MachineOptions& options);

// Names a part that may keep the machine from being faster, while both the pipeline and the ray caster work.
// The part with the least idle time comes first.
struct Bound {
  std::string name;
  double share = 0;  // part of the overlapped periods' cycles, 0..1
};
std::vector<Bound> bounds_of(const MachineReport& report, const MachineOptions& options);

}  // namespace voxmelt::hwmodel
