// The front of speed against error has a JSON file, a table of points, a page, and one for the docs.
#pragma once

#include <string>
#include <vector>

#include "accuracy/front/sweep.h"

namespace voxmelt::accuracy {

struct FrontReport {
  std::string version, implementation;
  front::Extent extent = front::Extent::full;
  std::vector<front::Swept> swept;
  double seconds = 0;

  int points() const;
};

std::string json_text(const FrontReport& report);
std::string csv_text(const FrontReport& report);
std::string html_text(const FrontReport& report);
std::string markdown_text(const FrontReport& report);

std::string percent_text(double part);                        // "0.034 %"
std::string axes_text(const std::vector<front::Axis>& axes);  // "step, rays"

}  // namespace voxmelt::accuracy
