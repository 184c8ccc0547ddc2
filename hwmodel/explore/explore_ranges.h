// How the answer changes over the ranges of the numbers behind it, in words and as a picture.
#pragma once

#include <string>

#include "hwmodel/explore/explore_report.h"

namespace voxmelt::hwmodel::explore {

std::string ranges_sentence(const Explored& explored);  // follows the answer's sentence; may be empty
std::string ranges_table(const Explored& explored);

// Draws bars, `top` below the upper edge of the picture. The height depends on how many numbers matter.
double ranges_height(const Explored& explored);
std::string ranges_svg(const Explored& explored, double top, double width);

}  // namespace voxmelt::hwmodel::explore
