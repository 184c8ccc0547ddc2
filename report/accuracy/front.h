// The front of speed against error has a JSON file, a table, a page, and a summary in words.
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
  int axes() const;  // axes along which at least one point was measured
};

std::string json_text(const FrontReport& report);
std::string csv_text(const FrontReport& report);
std::string html_text(const FrontReport& report);
std::string markdown_text(const FrontReport& report);

std::string percent_text(double part);  // "0.034 %"

}  // namespace voxmelt::accuracy
