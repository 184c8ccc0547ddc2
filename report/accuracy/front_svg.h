// The pictures of the front have dots on logarithmic axes. The dots that none beats are joined and numbered.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "accuracy/front/pareto.h"

namespace voxmelt::accuracy {

struct FrontDot {
  front::Place place;
  std::string hover{}, label{};  // the label stands beside the dot
  std::size_t colour = 0;        // index of a colour in the style sheet
  bool usual = false;            // drawn with a ring
};

struct FrontChart {
  std::string title, x_label, y_label;
  std::vector<FrontDot> dots;
  bool logarithmic_x = true;
};

// Draws the chart. An error of 0 lies at the lower end.
std::string front_svg(const FrontChart& chart);

}  // namespace voxmelt::accuracy
