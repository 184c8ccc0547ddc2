#include <fmt/format.h>

#include <optional>
#include <string>

#include "report/bench/report.h"

namespace voxmelt::measure {
namespace {

std::string or_empty(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

std::string row_of(const Case& one) {
  std::string text = fmt::format("{},{},{},{},{},{},{},{},{}", name_of(one.subject), one.workload,
                                 one.implementation, one.threads, one.cells, one.active, one.rounds,
                                 one.seconds * 1e3, one.median_seconds * 1e3);
  for (const double seconds : one.step.phase) text += fmt::format(",{}", seconds * 1e3);
  return text + fmt::format(",{},{},{},{},{},{}\n", one.cells_per_second(), one.active_per_second(),
                            one.bytes_per_cell, or_empty(one.percent_of_roof()),
                            or_empty(one.ratio_to_baseline), or_empty(one.ratio_to_native));
}

// A step of a device has no phases, and no baseline.
std::string row_of(const std::string& device, const DeviceCase& one) {
  std::string text = fmt::format("step,{},{},1,{},{},{},{},", one.workload, device, one.cells, one.active,
                                 one.rounds, one.seconds * 1e3);
  text.append(step::kPhaseNames.size(), ',');
  return text + fmt::format(",{},{},{},{},,\n", static_cast<double>(one.cells) / one.seconds,
                            static_cast<double>(one.active) / one.seconds, one.bytes_per_cell,
                            one.percent_of_copy());
}

}  // namespace

std::string bench_csv(const Findings& findings) {
  std::string text =
      "subject,workload,implementation,threads,cells,active_cells,rounds,milliseconds,median_milliseconds";
  for (const auto& phase : step::kPhaseNames) text += fmt::format(",{}_milliseconds", phase);
  text +=
      ",cells_per_second,active_cells_per_second,bytes_per_cell,percent_of_roof,ratio_to_baseline,"
      "ratio_to_native_baseline\n";
  for (const Case& one : findings.cases) text += row_of(one);
  for (const DeviceCase& one : findings.device_cases) text += row_of(findings.device->implementation, one);
  return text;
}

}  // namespace voxmelt::measure
