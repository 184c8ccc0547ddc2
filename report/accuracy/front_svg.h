// The picture of a scene's front has dots on logarithmic axes. Dots of one axis have one colour, and a line
// joins those that are marked so.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace voxmelt::accuracy {

struct FrontDot {
  double seconds = 0, error = 0;
  std::string hover{}, label{};  // the label stands beside the dot
  std::size_t colour = 0;        // index of a colour in the style sheet
  bool joined = true;
};

struct FrontChart {
  std::string title, x_label, y_label;
  double usual_seconds = 0;  // drawn as an upright line
  std::vector<FrontDot> dots{};
};

// Draws the chart. Every error must be more than 0.
std::string front_svg(const FrontChart& chart);

}  // namespace voxmelt::accuracy
