// The pictures of the page are drawn as SVG in the page's own colours, which its style sheet names.
#pragma once

#include <string>

#include "report/accuracy/report.h"
#include "report/svg/chart.h"

namespace voxmelt::accuracy {

// Returns the chart as the page draws it.
page::Chart chart_of(const Chart& chart);

// Draws every row with a gate: |error| over the gate, on a logarithmic axis with the gate in its middle.
std::string overview_svg(const Report& report);

}  // namespace voxmelt::accuracy
