// The pictures of the page are drawn as SVG in the page's own colours, which its style sheet names.
#pragma once

#include <cstddef>
#include <string>

#include "report/accuracy/report.h"

namespace voxmelt::accuracy {

inline constexpr std::size_t kColours = 7;  // --c0 .. --c6 of the style sheet

std::string chart_svg(const Chart& chart);

// Draws every row with a gate: |error| over the gate, on a logarithmic axis with the gate in its middle.
std::string overview_svg(const Report& report);

}  // namespace voxmelt::accuracy
