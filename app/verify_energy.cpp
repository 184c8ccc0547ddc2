#include "app/verify_energy.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "hwmodel/explore/operation_energy.h"
#include "hwmodel/memory/ratio.h"

namespace voxmelt::app {
namespace {

using hwmodel::ratio;

// Operations need numbers of logic. A run has no device, so they are those of this one.
constexpr const char* kDevice = "zu7ev";

}  // namespace

RunCost cost_of(const hwmodel::VerifyReport& report, const hwmodel::Design& design, int clock_mhz,
                const std::optional<hwmodel::memory::Energy>& dram) {
  const hwmodel::explore::Device device = hwmodel::explore::load_device(kDevice, {});
  const hwmodel::explore::OperationEnergy energy =
      hwmodel::explore::energy_of_run(report, design.shape.lanes, device.family);
  RunCost cost;
  cost.cell_steps = static_cast<double>(design.shape.grid.cells()) * report.steps;
  cost.seconds = 1e-6 * ratio(report.cycles, clock_mhz);
  cost.add = 1e-3 * energy.add;
  cost.multiply = 1e-3 * energy.multiply;
  cost.buffer = 1e-3 * energy.buffer;
  if (dram) cost.dram = dram->all();
  return cost;
}

std::string text_of(const RunCost& cost, int clock_mhz) {
  const auto watts = [&](double energy) { return 1e-9 * ratio(energy, cost.seconds); };
  const auto part = [&](double energy) { return 100 * ratio(energy, cost.operations()); };
  std::string text = fmt::format(
      "energy of a cell-step: operations {:.3f} nJ as in 45 nm (add {:.0f} %, multiply {:.0f} %, buffers "
      "{:.0f} %)",
      ratio(cost.operations(), cost.cell_steps), part(cost.add), part(cost.multiply), part(cost.buffer));
  if (cost.dram) text += fmt::format(", DRAM {:.3f} nJ", ratio(*cost.dram, cost.cell_steps));
  text += fmt::format("; at {} MHz {:.3f} W", clock_mhz, watts(cost.operations()));
  if (cost.dram) text += fmt::format(" and {:.3f} W", watts(*cost.dram));
  return text + "\n";
}

nlohmann::ordered_json json_of(const RunCost& cost, int clock_mhz) {
  using Json = nlohmann::ordered_json;
  const auto per_step = [&](double energy) { return ratio(energy, cost.cell_steps); };
  const auto watts = [&](double energy) { return 1e-9 * ratio(energy, cost.seconds); };
  return {
      {"clock_mhz", clock_mhz},
      {"cell_steps", cost.cell_steps},
      {"nanojoules_per_cell_step",
       {{"add", per_step(cost.add)},
        {"multiply", per_step(cost.multiply)},
        {"buffers", per_step(cost.buffer)},
        {"operations", per_step(cost.operations())},
        {"dram", cost.dram ? Json(per_step(*cost.dram)) : Json()}}},
      {"watts",
       {{"operations", watts(cost.operations())}, {"dram", cost.dram ? Json(watts(*cost.dram)) : Json()}}}};
}

}  // namespace voxmelt::app
