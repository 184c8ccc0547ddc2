#include "measure/texts.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

namespace voxmelt::measure {

std::string size_text(std::size_t bytes) {
  if (bytes >= std::size_t{1} << 30) return fmt::format("{:.0f} GiB", static_cast<double>(bytes) / (1 << 30));
  if (bytes >= std::size_t{1} << 20) return fmt::format("{} MiB", bytes >> 20);
  return fmt::format("{} KiB", bytes >> 10);
}

std::string three_digits(double value) {
  if (!std::isfinite(value)) return "–";
  const double size = std::abs(value);
  if (size >= 99.95) return fmt::format("{:.0f}", value);
  if (size >= 9.995) return fmt::format("{:.1f}", value);
  if (size >= 0.9995) return fmt::format("{:.2f}", value);
  return fmt::format("{:.3f}", value);
}

std::string or_dash(const std::optional<double>& value) { return value ? three_digits(*value) : "–"; }
std::string percent_or_dash(const std::optional<double>& value) {
  return value ? fmt::format("{:.0f} %", *value) : "–";
}
std::string threads_text(int threads) { return fmt::format("{} thread{}", threads, threads == 1 ? "" : "s"); }
std::string milliseconds(double seconds) { return three_digits(seconds * 1e3); }

std::string busy_text(double load, int own, int processors) {
  if (load - own < 0.25 * processors) return "";
  return fmt::format(
      "the load average is {:.1f} on {}: other programs take processors, and times and ratios may be far off",
      load, processors == 1 ? "1 processor" : fmt::format("{} processors", processors));
}

}  // namespace voxmelt::measure
