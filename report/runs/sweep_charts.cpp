#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/runs/sweep_page.h"

namespace voxmelt::page {
namespace {

double liquid_percent(const SweepRun& run) {
  const double all = run.solid + run.liquid;
  return all > 0 ? 100 * run.liquid / all : 0;
}
double matter(const SweepRun& run) { return run.solid + run.liquid; }

struct Quantity {
  const char *title, *label;
  double (*value_of)(const SweepRun&);
};
constexpr Quantity kQuantities[] = {{"Liquid at the end", "% of all matter", liquid_percent},
                                    {"Matter at the end", "full cells", matter}};

std::vector<const SweepRun*> complete_runs(const SweepPage& page) {
  std::vector<const SweepRun*> runs;
  for (const SweepRun& run : page.runs)
    if (run.complete) runs.push_back(&run);
  return runs;
}

bool varies(const std::vector<const SweepRun*>& runs, const Quantity& quantity) {
  return std::ranges::any_of(runs, [&](const SweepRun* run) {
    return std::abs(quantity.value_of(*run) - quantity.value_of(*runs.front())) >
           1e-9 * std::abs(quantity.value_of(*runs.front()));
  });
}

// Lists the different values of an axis, in the order of the runs.
std::vector<std::string> values_of(const SweepPage& page, std::size_t axis) {
  std::vector<std::string> values;
  for (const SweepRun& run : page.runs)
    if (std::ranges::find(values, run.values[axis]) == values.end()) values.push_back(run.values[axis]);
  return values;
}

bool is_numeric(const SweepPage& page, std::size_t axis) {
  return std::ranges::all_of(page.runs, [&](const SweepRun& run) { return run.numbers[axis].has_value(); });
}

// Values that differ by more than a hundred times, and are spread evenly by their ratios, have a logarithmic
// axis.
bool is_logarithmic(const SweepPage& page, std::size_t axis) {
  double low = 1e300, high = 0;
  for (const SweepRun& run : page.runs) {
    low = std::min(low, *run.numbers[axis]);
    high = std::max(high, *run.numbers[axis]);
  }
  return low > 0 && high / low >= 50;
}

using Runs = std::vector<const SweepRun*>;

// Returns by how much the mean of a quantity differs between the values of an axis.
double effect_of(const Runs& runs, std::size_t axis, const Quantity& quantity) {
  std::map<std::string, std::pair<double, int>> sums;
  for (const SweepRun* run : runs) {
    sums[run->values[axis]].first += quantity.value_of(*run);
    ++sums[run->values[axis]].second;
  }
  double low = 1e300, high = -1e300;
  for (const auto& [value, sum] : sums) {
    low = std::min(low, sum.first / sum.second);
    high = std::max(high, sum.first / sum.second);
  }
  return high - low;
}

// Returns the axis whose values have colours: of those with few values the one that matters most, but not the
// one that is drawn along x.
std::optional<std::size_t> coloured_axis(const SweepPage& page, const Runs& runs, std::size_t x,
                                         const Quantity& quantity) {
  std::optional<std::size_t> best;
  for (std::size_t axis = 0; axis < page.axes.size(); ++axis) {
    const std::size_t count = values_of(page, axis).size();
    if (axis == x || count < 2 || count > kColours) continue;
    if (!best || effect_of(runs, axis, quantity) > effect_of(runs, *best, quantity)) best = axis;
  }
  return best;
}

std::string end_of(const std::string& key) { return key.substr(key.rfind('.') + 1); }

// Draws a dot for each run. A line joins the means, where runs share a place along x.
Chart chart_over(const SweepPage& page, const std::vector<const SweepRun*>& runs, std::size_t x,
                 const Quantity& quantity) {
  Chart chart{.title = fmt::format("{}, over {}", quantity.title, page.axes[x]),
              .x_label = page.axes[x],
              .y_label = quantity.label,
              .logarithmic_x = is_logarithmic(page, x)};
  const std::optional<std::size_t> coloured = coloured_axis(page, runs, x, quantity);
  const std::vector<std::string> values =
      coloured ? values_of(page, *coloured) : std::vector<std::string>{""};
  for (std::size_t colour = 0; colour < values.size(); ++colour) {
    const std::string name =
        coloured ? fmt::format("{} = {}", end_of(page.axes[*coloured]), values[colour]) : std::string();
    Curve dots{.name = name, .joined = false, .colour = colour};
    Curve means{.name = name, .mark = Mark::line, .colour = colour};
    std::map<double, std::pair<double, int>> sums;
    for (const SweepRun* run : runs) {
      if (coloured && run->values[*coloured] != values[colour]) continue;
      const double at = *run->numbers[x], value = quantity.value_of(*run);
      dots.points.push_back({at, value});
      sums[at].first += value;
      ++sums[at].second;
    }
    for (const auto& [at, sum] : sums) means.points.push_back({at, sum.first / sum.second});
    const bool shared = values_of(page, x).size() < page.runs.size() || page.axes.size() == 1;
    chart.curves.push_back(std::move(dots));
    if (shared && means.points.size() > 1) chart.curves.push_back(std::move(means));
  }
  return chart;
}

// Draws how each run melts, coloured by the value of an axis with few values.
Chart chart_of_steps(const SweepPage& page, const std::vector<const SweepRun*>& runs) {
  Chart chart{.title = "Liquid while it melts", .x_label = "step", .y_label = "% of all matter"};
  const std::optional<std::size_t> coloured = coloured_axis(page, runs, page.axes.size(), kQuantities[0]);
  const std::vector<std::string> values = coloured ? values_of(page, *coloured) : std::vector<std::string>{};
  for (const SweepRun* run : runs) {
    if (run->curve.size() < 2) continue;
    Curve curve{.points = run->curve, .mark = Mark::line, .colour = 0};
    if (coloured) {
      const auto at = std::ranges::find(values, run->values[*coloured]);
      curve.colour = static_cast<std::size_t>(at - values.begin());
      curve.name = fmt::format("{} = {}", end_of(page.axes[*coloured]), *at);
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

}  // namespace

std::vector<Chart> sweep_charts(const SweepPage& page) {
  std::vector<Chart> charts;
  const std::vector<const SweepRun*> runs = complete_runs(page);
  if (runs.size() < 2) return charts;
  for (const Quantity& quantity : kQuantities)
    for (std::size_t axis = 0; axis < page.axes.size(); ++axis)
      if (is_numeric(page, axis) && values_of(page, axis).size() > 1 && varies(runs, quantity))
        charts.push_back(chart_over(page, runs, axis, quantity));
  if (Chart chart = chart_of_steps(page, runs); !chart.curves.empty()) charts.push_back(std::move(chart));
  return charts;
}

}  // namespace voxmelt::page
