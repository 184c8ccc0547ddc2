#include "report/runs/steps_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

namespace voxmelt::page {

std::optional<std::size_t> StepsTable::find(const std::string& column) const {
  const auto at = std::ranges::find(columns, column);
  if (at == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(at - columns.begin());
}

std::vector<Point> StepsTable::over_steps(std::size_t column) const {
  std::vector<Point> points;
  for (const std::vector<double>& row : rows) points.push_back({row[0], row[column]});
  return points;
}

std::optional<StepsTable> read_steps(const std::filesystem::path& file) {
  std::ifstream stream(file);
  StepsTable table;
  std::string line, word;
  if (!std::getline(stream, line)) return std::nullopt;
  for (std::istringstream words(line); std::getline(words, word, ',');) table.columns.push_back(word);
  if (table.columns.empty() || table.columns.front() != "step") return std::nullopt;
  while (std::getline(stream, line)) {
    std::vector<double> row;
    for (std::istringstream words(line); std::getline(words, word, ',');) {
      double number = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
      if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number))
        return std::nullopt;
      row.push_back(number);
    }
    if (row.size() != table.columns.size()) return std::nullopt;
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<Point> liquid_share(const StepsTable& table) {
  const std::optional<std::size_t> solid = table.find("solid_mass"), liquid = table.find("liquid_mass");
  std::vector<Point> points;
  if (!solid || !liquid) return points;
  for (const std::vector<double>& row : table.rows) {
    const double all = row[*solid] + row[*liquid];
    points.push_back({row[0], all > 0 ? 100 * row[*liquid] / all : 0});
  }
  return points;
}

}  // namespace voxmelt::page
