// The page of a sweep shows how its runs differ: plots over the axes, a small picture of each run, a table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/svg/chart.h"

namespace voxmelt::page {

struct SweepRun {
  std::string name;
  std::vector<std::string> values{};             // one of each axis
  std::vector<std::optional<double>> numbers{};  // the same, where they are numbers
  bool complete = false;                         // what follows is known of complete runs
  std::string picture{};                         // path from the page; empty for none
  std::string digest{};
  double steps = 0, solid = 0, liquid = 0;  // at the end; matter in full cells
  double seconds = 0;
  std::vector<Point> curve{};  // liquid, in percent of all matter, over the steps; may be empty
  std::string failure{};       // why it failed; empty if it did not
};

struct SweepPage {
  std::string title, scene;
  std::vector<std::string> axes{};
  std::vector<SweepRun> runs{};
};

std::string sweep_html(const SweepPage& page);

// Returns the charts of the page: how runs end over each axis, and how they melt.
std::vector<Chart> sweep_charts(const SweepPage& page);

}  // namespace voxmelt::page
