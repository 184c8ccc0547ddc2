#include "report/runs/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "report/svg/svg.h"

namespace voxmelt::page {
namespace {

constexpr double kMargin = 24, kTitle = 26, kGap = 30, kNameRow = 20, kLetter = 7.2;

// The colours of the style sheet by day. Many programs that show SVG know no variables.
constexpr const char* kPlotStyle = R"(
text { fill: #646a73; font: 12px "DejaVu Sans", "Helvetica Neue", Arial, sans-serif; }
.title { fill: #1f2328; font-size: 14px; font-weight: bold; } .label { font-size: 12.5px; } .name { fill: #1f2328; }
.grid { stroke: #e4e1da; stroke-width: 1; } .zero, .mark { stroke: #646a73; stroke-width: 1; }
.joined { fill: none; stroke-width: 1.6; } .exact { fill: none; stroke: #1f2328; stroke-width: 1.8; }
.k0 { stroke: #c8571b; } .k1 { stroke: #2b5fa8; } .k2 { stroke: #7a4fa3; } .k3 { stroke: #2a7f62; }
.k4 { stroke: #b02a63; } .k5 { stroke: #7d6a12; } .k6 { stroke: #0e7c8a; }
.f0 { fill: #c8571b; } .f1 { fill: #2b5fa8; } .f2 { fill: #7a4fa3; } .f3 { fill: #2a7f62; }
.f4 { fill: #b02a63; } .f5 { fill: #7d6a12; } .f6 { fill: #0e7c8a; }
)";

std::string curve_dashes(const Curve& curve) { return curve.dashes.empty() ? "none" : curve.dashes; }

struct Names {
  std::string svg;
  double height = 0;
};

// Writes the names of curves in columns, each behind its colour.
Names names_of(const Chart& chart, double width) {
  Names names;
  std::size_t longest = 1, row = 0, column = 0;
  for (const Curve& curve : chart.curves) longest = std::max(longest, curve.name.size());
  const double step = 34 + kLetter * static_cast<double>(longest);
  const auto columns = std::max<std::size_t>(1, static_cast<std::size_t>((width - 2 * kMargin) / step));
  const std::vector<std::size_t> colours = colours_of(chart);
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const double x = kMargin + step * static_cast<double>(column);
    const double y = kMargin + kNameRow * static_cast<double>(row);
    names.svg += fmt::format(R"(<path class="joined k{}" stroke-dasharray="{}" d="M{:.1f} {:.1f}h16"/>)",
                             colours[i], curve_dashes(chart.curves[i]), x, y);
    names.svg += text(x + 22, y + 4, "start", chart.curves[i].name, "name") + "\n";
    if (++column == columns) {
      column = 0;
      ++row;
    }
  }
  names.height = kNameRow * static_cast<double>(row + (column > 0 ? 1 : 0));
  return names;
}

}  // namespace

std::string plot_svg(const std::vector<Chart>& charts) {
  const std::size_t columns = charts.size() > 1 ? 2 : 1, rows = (charts.size() + columns - 1) / columns;
  const double wide = kChartWidth + kGap, high = kChartHeight + kTitle + kGap;
  const double width = 2 * kMargin + wide * static_cast<double>(columns) - kGap;
  const Names names = names_of(charts.front(), width);
  const double top = kMargin + names.height + 4;
  const double height = top + high * static_cast<double>(rows) + kMargin - kGap;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\">\n<style>{2}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      width, height, kPlotStyle);
  svg += names.svg;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const std::size_t row = i / columns, column = i % columns;
    const double x = kMargin + wide * static_cast<double>(column), y = top + high * static_cast<double>(row);
    svg += fmt::format("<g transform=\"translate({:.1f} {:.1f})\">", x, y) +
           text(0, 14, "start", charts[i].title, "title") +
           fmt::format("<g transform=\"translate(0 {:.1f})\">", kTitle) + chart_marks(charts[i]) +
           "</g></g>\n";
  }
  return svg + "</svg>\n";
}

}  // namespace voxmelt::page
