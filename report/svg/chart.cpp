#include "report/svg/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "report/svg/axis.h"
#include "report/svg/svg.h"

namespace voxmelt::page {
namespace {

constexpr double kLeft = 68, kRight = 506, kTop = 14, kBottom = 252;
constexpr std::size_t kJoinUpTo = 30;  // with more points, dots alone make the line

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

std::string frame_of(const Chart& chart, const Axis& x, const Axis& y) {
  std::string svg;
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
  svg += text((kLeft + kRight) / 2, kChartHeight - 8, "middle", chart.x_label, "label");
  svg += fmt::format(
      R"svg(<text class="label" transform="translate(14 {:.1f}) rotate(-90)" text-anchor="middle">{}</text>)svg",
      (kTop + kBottom) / 2, escaped(chart.y_label));
  return svg;
}

std::string marks_of(const Curve& curve, std::size_t colour, const Axis& x, const Axis& y) {
  if (curve.mark == Mark::exact) return fmt::format(R"(<path class="exact" d="{}"/>)", path(curve, x, y));
  if (curve.mark == Mark::line)
    return fmt::format(R"(<path class="joined k{}"{} d="{}"><title>{}</title></path>)", colour,
                       curve.dashes.empty() ? "" : " stroke-dasharray=\"" + curve.dashes + "\"",
                       path(curve, x, y), escaped(curve.name));
  std::string svg;
  const bool joined = curve.points.size() <= kJoinUpTo;
  if (joined && curve.joined)
    svg += fmt::format(R"(<path class="joined k{}" d="{}"/>)", colour, path(curve, x, y));
  for (const Point& p : curve.points)
    svg += fmt::format(
        R"(<circle class="f{}" cx="{:.1f}" cy="{:.1f}" r="{}"><title>{}: {:.6g}, {:.6g}</title></circle>)",
        colour, x(p.x), y(p.y), joined ? 3.4 : 2.2, escaped(curve.name), p.x, p.y);
  return svg;
}

std::string legend(const Chart& chart) {
  std::string out;
  bool exact = false;
  std::set<std::string> named;
  const std::vector<std::size_t> colours = colours_of(chart);
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const Curve& curve = chart.curves[i];
    if (curve.points.empty()) continue;
    if (curve.mark == Mark::exact) {
      if (!exact) out.insert(0, "<span><i class=\"line\"></i>exact</span>");
      exact = true;
    } else if (!curve.name.empty() && named.insert(curve.name).second) {
      out += fmt::format("<span><i class=\"b{}\"></i>{}</span>", colours[i], escaped(curve.name));
    }
  }
  return out;
}

}  // namespace

std::vector<std::size_t> colours_of(const Chart& chart) {
  std::vector<std::size_t> colours;
  std::size_t next = 0;
  for (const Curve& curve : chart.curves) {
    const bool own = curve.colour || curve.mark == Mark::exact || curve.points.empty();
    colours.push_back((own ? curve.colour.value_or(0) : next++) % kColours);
  }
  return colours;
}

std::string chart_marks(const Chart& chart) {
  const Range xs = range(chart, &Point::x);
  Range ys = range(chart, &Point::y);
  if (chart.band) ys = {std::min(ys.low, -1.25 * *chart.band), std::max(ys.high, 1.25 * *chart.band)};
  if (!chart.logarithmic_y && !chart.band && ys.low > 0 && ys.low < 0.5 * ys.high) ys.low = 0;
  const Axis x(xs.low, xs.high, chart.logarithmic_x, kLeft, kRight);
  const Axis y(ys.low, ys.high, chart.logarithmic_y, kBottom, kTop);
  std::string svg = frame_of(chart, x, y);
  const std::vector<std::size_t> colours = colours_of(chart);
  for (std::size_t i = 0; i < chart.curves.size(); ++i)
    if (!chart.curves[i].points.empty()) svg += marks_of(chart.curves[i], colours[i], x, y);
  return svg;
}

std::string chart_svg(const Chart& chart) {
  return fmt::format(R"(<svg viewBox="0 0 {} {}" role="img" aria-label="{}">)", kChartWidth, kChartHeight,
                     escaped(chart.title)) +
         chart_marks(chart) + "</svg>";
}

std::string chart_figure(const Chart& chart) {
  return fmt::format("<figure><figcaption>{}</figcaption><div class=\"legend\">{}</div>{}</figure>\n",
                     escaped(chart.title), legend(chart), chart_svg(chart));
}

}  // namespace voxmelt::page
