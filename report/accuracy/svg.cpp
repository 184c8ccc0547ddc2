#include "report/accuracy/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "report/svg/axis.h"
#include "report/svg/svg.h"

namespace voxmelt::accuracy {
namespace {

constexpr double kWidth = 520, kHeight = 300, kLeft = 68, kRight = 506, kTop = 14, kBottom = 252;
constexpr std::size_t kJoinUpTo = 30;  // with more points, dots alone make the line

using page::Axis;
using page::escaped;
using page::line;
using page::text;

std::string tick_text(double value) {
  std::string out = fmt::format("{:g}", value);
  if (out[0] == '-') out.replace(0, 1, "−");
  return out;
}

std::string path(const Curve& curve, const Axis& x, const Axis& y) {
  std::string out;
  for (const Point& p : curve.points)
    out += fmt::format("{}{:.1f} {:.1f}", out.empty() ? "M" : "L", x(p.x), y(p.y));
  return out;
}

struct Range {
  double low = 0, high = 1;
};
Range range(const Chart& chart, double Point::*member) {
  bool first = true;
  Range all;
  for (const Curve& curve : chart.curves)
    for (const Point& p : curve.points) {
      const double value = p.*member;
      all = first ? Range{value, value} : Range{std::min(all.low, value), std::max(all.high, value)};
      first = false;
    }
  return all;
}

}  // namespace

std::string chart_svg(const Chart& chart) {
  const Range xs = range(chart, &Point::x);
  Range ys = range(chart, &Point::y);
  if (chart.band) ys = {std::min(ys.low, -1.25 * *chart.band), std::max(ys.high, 1.25 * *chart.band)};
  if (!chart.logarithmic_y && !chart.band && ys.low > 0 && ys.low < 0.5 * ys.high) ys.low = 0;
  const Axis x(xs.low, xs.high, chart.logarithmic_x, kLeft, kRight);
  const Axis y(ys.low, ys.high, chart.logarithmic_y, kBottom, kTop);

  std::string svg = fmt::format(R"(<svg viewBox="0 0 {} {}" role="img" aria-label="{}">)", kWidth, kHeight,
                                escaped(chart.title));
  for (const double tick : y.ticks()) {
    svg += line(kLeft, y(tick), kRight, y(tick), tick == 0 ? "zero" : "grid");
    svg += text(kLeft - 7, y(tick) + 4, "end", tick_text(tick));
  }
  for (const double tick : x.ticks()) {
    svg += line(x(tick), kBottom, x(tick), kBottom + 4, "mark");
    svg += text(x(tick), kBottom + 18, "middle", tick_text(tick));
  }
  svg += line(kLeft, kBottom, kRight, kBottom, "mark");
  if (chart.band)
    svg += fmt::format(R"(<rect class="band" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"/>)", kLeft,
                       y(*chart.band), kRight - kLeft, y(-*chart.band) - y(*chart.band));
  svg += text((kLeft + kRight) / 2, kHeight - 8, "middle", chart.x_label, "label");
  svg += fmt::format(
      R"svg(<text class="label" transform="translate(14 {:.1f}) rotate(-90)" text-anchor="middle">{}</text>)svg",
      (kTop + kBottom) / 2, escaped(chart.y_label));

  std::size_t colour = 0;
  for (const Curve& curve : chart.curves) {
    if (curve.points.empty()) continue;
    if (curve.exact) {
      svg += fmt::format(R"(<path class="exact" d="{}"/>)", path(curve, x, y));
      continue;
    }
    const std::size_t c = colour++ % kColours;
    const bool joined = curve.points.size() <= kJoinUpTo;
    if (joined && curve.joined)
      svg += fmt::format(R"(<path class="joined k{}" d="{}"/>)", c, path(curve, x, y));
    for (const Point& p : curve.points)
      svg += fmt::format(
          R"(<circle class="f{}" cx="{:.1f}" cy="{:.1f}" r="{}"><title>{}: {:.6g}, {:.6g}</title></circle>)",
          c, x(p.x), y(p.y), joined ? 3.4 : 2.2, escaped(curve.name), p.x, p.y);
  }
  return svg + "</svg>";
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
