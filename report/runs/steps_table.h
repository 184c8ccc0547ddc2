// The table steps.csv of a run, as `voxmelt run --write csv` writes it, is read again.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "report/svg/chart.h"

namespace voxmelt::page {

struct StepsTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  std::optional<std::size_t> find(const std::string& column) const;
  // Returns a column over the steps. The column must be there.
  std::vector<Point> over_steps(std::size_t column) const;
};

// Returns nothing if the file is missing, or is no such table.
std::optional<StepsTable> read_steps(const std::filesystem::path& file);

// Returns which part of the matter is liquid, over the steps.
std::vector<Point> liquid_share(const StepsTable& table);

}  // namespace voxmelt::page
