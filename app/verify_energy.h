// The energy of a verified run is that of its operations and that of its DRAM, for each step of a cell.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "hwmodel/memory/energy.h"
#include "hwmodel/pipeline/check/verify.h"

namespace voxmelt::app {

struct RunCost {
  double cell_steps = 0, seconds = 0;        // of the machine
  double add = 0, multiply = 0, buffer = 0;  // nJ of all operations
  std::optional<double> dram;                // nJ; none without a DRAM whose sheet has currents
  double operations() const { return add + multiply + buffer; }
};

RunCost cost_of(const hwmodel::VerifyReport& report, const hwmodel::Design& design, int clock_mhz,
                const std::optional<hwmodel::memory::Energy>& dram);

std::string text_of(const RunCost& cost, int clock_mhz);
nlohmann::ordered_json json_of(const RunCost& cost, int clock_mhz);

}  // namespace voxmelt::app
