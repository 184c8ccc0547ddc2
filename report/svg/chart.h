// A chart shows curves over two axes. It is drawn as SVG in the colours of the style sheet (style.h).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace voxmelt::page {

inline constexpr std::size_t kColours = 7;  // --c0 .. --c6 of the style sheet

struct Point {
  double x = 0, y = 0;
};

enum class Mark : unsigned char {
  dots,  // measured points
  line,  // a line in the curve's colour
  exact  // a line in the colour of text
};

struct Curve {
  std::string name{};
  std::vector<Point> points{};
  Mark mark = Mark::dots;
  bool joined = true;                   // few dots are joined by a thin line
  std::optional<std::size_t> colour{};  // a colour of its own; else the next one
  std::string dashes{};                 // of a line: lengths of marks and gaps; empty for none
};

struct Chart {
  std::string title{}, x_label{}, y_label{};
  std::vector<Curve> curves{};
  bool logarithmic_x = false, logarithmic_y = false;
  std::optional<double> band{};  // the bound of an error, drawn from -band to band
};

inline constexpr double kChartWidth = 520, kChartHeight = 300;

// Draws what is within the <svg> of a chart.
std::string chart_marks(const Chart& chart);
// Draws the chart as an <svg> element.
std::string chart_svg(const Chart& chart);
// Makes a <figure> with title, legend and chart. A name that several curves have stands once.
std::string chart_figure(const Chart& chart);

// Gives each curve that is drawn its colour, in the order of the curves.
std::vector<std::size_t> colours_of(const Chart& chart);

}  // namespace voxmelt::page
