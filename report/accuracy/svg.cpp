#include "report/accuracy/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/svg/svg.h"

namespace voxmelt::accuracy {
namespace {

using page::escaped;
using page::line;
using page::text;

page::Curve curve_of(const Curve& curve) {
  page::Curve drawn{.name = curve.name, .joined = curve.joined};
  for (const Point& p : curve.points) drawn.points.push_back({p.x, p.y});
  if (curve.exact) drawn.mark = page::Mark::exact;
  return drawn;
}

}  // namespace

page::Chart chart_of(const Chart& chart) {
  page::Chart drawn{.title = chart.title,
                    .x_label = chart.x_label,
                    .y_label = chart.y_label,
                    .logarithmic_x = chart.logarithmic_x,
                    .logarithmic_y = chart.logarithmic_y,
                    .band = chart.band};
  for (const Curve& curve : chart.curves) drawn.curves.push_back(curve_of(curve));
  return drawn;
}

std::string overview_svg(const Report& report) {
  constexpr double kRow = 19, kNames = 150, kEnd = 1040, kFurthest = 1000;
  const double middle = kNames + (kEnd - kNames) / 2;
  // The axis goes from a thousandth of the bar to a thousand times. An error of 0 is within a gate of 0.
  const auto place = [&](const Row& row) {
    const double error = std::abs(row.error()), ratio = error == 0 ? 0 : error / row.bar();
    const double decades = std::isfinite(ratio) ? std::log10(std::max(ratio, 1 / kFurthest)) : 3;
    return middle + std::clamp(decades / std::log10(kFurthest), -1.0, 1.0) * (kEnd - 10 - middle);
  };
  std::string body;
  double y = 30;
  for (const Found& found : report.found) {
    std::string dots;
    for (const Row& row : found.outcome.rows)
      dots += fmt::format(
          R"(<circle class="{}" cx="{:.1f}" cy="{:.1f}" r="5.2"><title>{}, {}: error {}, {}</title></circle>)",
          !row.gate      ? "told"
          : row.passed() ? "good"
                         : "bad",
          place(row), y, escaped(row.setting), escaped(row.quantity), error_text(row),
          row.gate ? "gate " + gate_text(row) : "reported");
    if (dots.empty()) continue;
    body += line(kNames, y, kEnd, y, "grid");
    body += fmt::format(
                R"(<a href="#{0}"><text class="name" x="{1}" y="{2:.1f}" text-anchor="end">{0}</text></a>)",
                found.one->name, kNames - 12, y + 4) +
            dots;
    y += kRow;
  }
  std::string svg = fmt::format(
      R"(<svg class="overview" viewBox="0 0 {} {:.0f}" role="img" aria-label="Every error beside its bar">)",
      kEnd + 12, y + 6);
  for (int decade = -3; decade <= 3; ++decade) {
    const double x = middle + decade / 3.0 * (kEnd - 10 - middle);
    svg += line(x, 16, x, y - 8, decade == 0 ? "gate" : "grid");
    svg += text(x, 10, "middle",
                decade == 0  ? "the bar"
                : decade < 0 ? fmt::format("1/{:g}", std::pow(10, -decade))
                             : fmt::format("{:g} ×", std::pow(10, decade)));
  }
  return svg + body + "</svg>";
}

}  // namespace voxmelt::accuracy
