// Curves of one run or of many are drawn as one SVG file, which needs no style sheet beside it.
#pragma once

#include <string>
#include <vector>

#include "report/svg/chart.h"

namespace voxmelt::page {

// Draws the charts side by side, and the names of curves once above them: those of the first chart.
std::string plot_svg(const std::vector<Chart>& charts);

}  // namespace voxmelt::page
