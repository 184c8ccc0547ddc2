#include "report/accuracy/front_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "report/svg/axis.h"
#include "report/svg/svg.h"

namespace voxmelt::accuracy {
namespace {

constexpr double kWidth = 440, kHeight = 320, kLeft = 78, kRight = 424, kTop = 18, kBottom = 264;
constexpr double kLeastError = 1e-10, kRoom = 1.35;

using page::Axis;
using page::escaped;
using page::text;

std::string line(double x1, double y1, double x2, double y2) { return page::line(x1, y1, x2, y2, "grid"); }

double shown(double error) { return 100 * std::max(error, kLeastError); }  // in percent

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

}  // namespace

std::string front_svg(const FrontChart& chart) {
  if (chart.dots.empty()) return "";
  const Range xs =
      range(chart.dots, chart.logarithmic_x ? kRoom : 1, [](const FrontDot& d) { return d.place.cost; });
  const Range ys = range(chart.dots, kRoom, [](const FrontDot& d) { return shown(d.place.error); });
  const Axis x(chart.logarithmic_x ? xs.low : 0, xs.high, chart.logarithmic_x, kLeft, kRight);
  const Axis y(ys.low, ys.high, true, kBottom, kTop);

  std::string svg = fmt::format(R"(<svg viewBox="0 0 {} {}" role="img" aria-label="{}">)", kWidth, kHeight,
                                escaped(chart.title));
  svg += grid_of(x, y);
  svg += text((kLeft + kRight) / 2, kHeight - 10, "middle", chart.x_label, "label");
  svg += fmt::format(
      R"svg(<text class="label" transform="translate(14 {:.1f}) rotate(-90)" text-anchor="middle">{}</text>)svg",
      (kTop + kBottom) / 2, escaped(chart.y_label));

  std::vector<front::Place> places;
  for (const FrontDot& dot : chart.dots) places.push_back(dot.place);
  std::string path;
  for (const std::size_t i : front::undominated(places))
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x(places[i].cost),
                        y(shown(places[i].error)));
  svg += fmt::format(R"(<path class="exact front" d="{}"/>)", path);

  for (const FrontDot& dot : chart.dots) {
    const double at_x = x(dot.place.cost), at_y = y(shown(dot.place.error));
    if (dot.usual) svg += fmt::format(R"(<circle class="ring" cx="{:.1f}" cy="{:.1f}" r="9"/>)", at_x, at_y);
    svg += fmt::format(R"(<circle class="f{}" cx="{:.1f}" cy="{:.1f}" r="5"><title>{}</title></circle>)",
                       dot.colour, at_x, at_y, escaped(dot.hover));
    if (!dot.label.empty())
      svg += at_x > kRight - 60 ? text(at_x - 8, at_y - 8, "end", dot.label, "name")
                                : text(at_x + 8, at_y - 6, "start", dot.label, "name");
  }
  return svg + "</svg>";
}

}  // namespace voxmelt::accuracy
