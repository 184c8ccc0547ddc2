#include <fmt/format.h>

#include <optional>
#include <string>

#include "report/accuracy/report.h"

namespace voxmelt::accuracy {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

}  // namespace

std::string csv_text(const Report& report) {
  std::string out =
      "name,setting,quantity,value,exact,error,error_is,gate,passed,cells_per_second,"
      "baseline_cells_per_second,state_bits,note\n";
  const auto or_empty = [](const std::optional<double>& v) { return v ? fmt::format("{}", *v) : ""; };
  for (const Found& found : report.found)
    for (const Row& row : found.outcome.rows)
      out +=
          fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", found.one->name, quoted(row.setting),
                      quoted(row.quantity), row.value, row.exact, row.error(),
                      row.measure == Measure::relative ? "relative" : "absolute", or_empty(row.gate),
                      row.passed(), row.speed.cells_per_second, or_empty(row.speed.baseline_cells_per_second),
                      row.speed.state_bits, quoted(row.note));
  return out;
}

}  // namespace voxmelt::accuracy
