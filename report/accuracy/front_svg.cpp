#include "report/accuracy/front_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "report/svg/axis.h"
#include "report/svg/svg.h"

namespace voxmelt::accuracy {
namespace {

constexpr double kWidth = 440, kHeight = 320, kLeft = 78, kRight = 424, kTop = 18, kBottom = 264;
constexpr double kRoom = 1.35;

using page::Axis;
using page::escaped;
using page::text;

std::string line(double x1, double y1, double x2, double y2) { return page::line(x1, y1, x2, y2, "grid"); }

double percent(double error) { return 100 * error; }

struct Range {
  double low, high;
};
template <class Value>
Range range(const std::vector<FrontDot>& dots, double room, const Value& value) {
  Range all{value(dots.front()), value(dots.front())};
  for (const FrontDot& dot : dots) all = {std::min(all.low, value(dot)), std::max(all.high, value(dot))};
  return {all.low / room, all.high * room};
}

std::string grid_of(const Axis& x, const Axis& y) {
  std::string svg;
  double before = kBottom + 100;
  for (const double tick : y.ticks()) {
    if (before - y(tick) < 13) continue;  // two texts would touch
    before = y(tick);
    svg += line(kLeft, y(tick), kRight, y(tick));
    svg += text(kLeft - 7, y(tick) + 4, "end", fmt::format("{:g}", tick), "tick");
  }
  before = -100;
  for (const double tick : x.ticks()) {
    if (x(tick) - before < 34) continue;
    before = x(tick);
    svg += line(x(tick), kTop, x(tick), kBottom);
    svg += text(x(tick), kBottom + 18, "middle", fmt::format("{:g}", tick), "tick");
  }
  return svg;
}

// Joins the dots of each colour, the fastest first.
std::string lines_of(const std::vector<FrontDot>& dots, const Axis& x, const Axis& y) {
  std::map<std::size_t, std::map<double, double>> errors;  // by colour and seconds
  for (const FrontDot& dot : dots)
    if (dot.joined) errors[dot.colour][dot.seconds] = dot.error;
  std::string svg;
  for (const auto& [colour, line_of_colour] : errors) {
    std::string path;
    for (const auto& [seconds, error] : line_of_colour)
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x(seconds), y(percent(error)));
    svg += fmt::format(R"(<path class="joined k{}" d="{}"/>)", colour, path);
  }
  return svg;
}

std::string drawn(const FrontDot& dot, const Axis& x, const Axis& y) {
  const double at_x = x(dot.seconds), at_y = y(percent(dot.error));
  return fmt::format(R"(<circle class="f{}" cx="{:.1f}" cy="{:.1f}" r="4.5"><title>{}</title></circle>)",
                     dot.colour, at_x, at_y, escaped(dot.hover)) +
         (at_x > kRight - 60 ? text(at_x - 7, at_y + 4, "end", dot.label, "name")
                             : text(at_x + 7, at_y + 4, "start", dot.label, "name"));
}

}  // namespace

std::string front_svg(const FrontChart& chart) {
  if (chart.dots.empty()) return "";
  Range xs = range(chart.dots, kRoom, [](const FrontDot& d) { return d.seconds; });
  xs = {std::min(xs.low, chart.usual_seconds), std::max(xs.high, chart.usual_seconds)};
  const Range ys = range(chart.dots, kRoom, [](const FrontDot& d) { return percent(d.error); });
  const Axis x(xs.low, xs.high, true, kLeft, kRight);
  const Axis y(ys.low, ys.high, true, kBottom, kTop);

  std::string svg = fmt::format(R"(<svg viewBox="0 0 {} {}" role="img" aria-label="{}">)", kWidth, kHeight,
                                escaped(chart.title));
  svg += grid_of(x, y);
  svg += page::line(x(chart.usual_seconds), kTop, x(chart.usual_seconds), kBottom, "gate");
  svg += text((kLeft + kRight) / 2, kHeight - 10, "middle", chart.x_label, "label");
  svg += fmt::format(
      R"svg(<text class="label" transform="translate(14 {:.1f}) rotate(-90)" text-anchor="middle">{}</text>)svg",
      (kTop + kBottom) / 2, escaped(chart.y_label));
  svg += lines_of(chart.dots, x, y);
  for (const FrontDot& dot : chart.dots) svg += drawn(dot, x, y);
  return svg + "</svg>";
}

}  // namespace voxmelt::accuracy
