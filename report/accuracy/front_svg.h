// Pictures of the front: dots on logarithmic axes, those that none beats joined and numbered.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "accuracy/front/pareto.h"

namespace voxmelt::accuracy {

struct FrontDot {
  front::Place place;
  std::string hover{}, label{};  // the label stands beside the dot
  std::size_t colour = 0;        // of the style sheet
  bool usual = false;            // drawn with a ring
};

struct FrontChart {
  std::string title, x_label, y_label;
  std::vector<FrontDot> dots;
  bool logarithmic_x = true;
};

// An error of 0 lies at the lower end.
std::string front_svg(const FrontChart& chart);

}  // namespace voxmelt::accuracy
