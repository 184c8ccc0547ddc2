// The functions here write numbers for readers.
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "report/accuracy/report.h"

namespace voxmelt::accuracy {
namespace {

std::string signed_digits(double value, const char* unit) {
  const double size = std::abs(value);
  if (size == 0) return std::string("0") + unit;
  if (size < 0.0005) return fmt::format("{:+.0e}{}", value, unit);
  const int digits = size >= 100 ? 0 : size >= 10 ? 1 : size >= 0.1 ? 2 : 3;
  return fmt::format("{:+.{}f}{}", value, digits, unit);
}

}  // namespace

std::string number_text(double value) {
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (size < 0.0001) return fmt::format("{:.1e}", value);
  return fmt::format("{:.{}f}", value, size >= 1000 ? 0 : size >= 100 ? 1 : size >= 10 ? 2 : 3);
}

std::string error_text(const Row& row) {
  return row.measure == Measure::relative ? signed_digits(100 * row.error(), " %")
                                          : signed_digits(row.error(), "");
}

std::string gate_text(const Row& row) {
  if (!row.gate) return "reported";
  return row.measure == Measure::relative ? fmt::format("{:g} %", 100 * *row.gate)
                                          : fmt::format("{:g}", *row.gate);
}

std::string speed_text(double cells_per_second) {
  const double m = cells_per_second / 1e6;
  return fmt::format("{:.{}f}", m, m >= 100 ? 0 : m >= 10 ? 1 : 2);
}

}  // namespace voxmelt::accuracy
