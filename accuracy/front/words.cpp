#include "accuracy/front/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>

#include "accuracy/front/pareto.h"

namespace voxmelt::accuracy::front {
namespace {

std::vector<Pick> picks(const Swept& swept, const Plotted& plotted) {
  const auto at = [&](std::optional<std::size_t> place) {
    return place ? &swept.points[plotted.point[*place]] : nullptr;
  };
  std::vector<Pick> found;
  for (const double bound : kBounds)
    found.push_back({fmt::format("{:g} %", 100 * bound), at(cheapest_within(plotted.places, bound))});
  found.push_back({"best", at(best(plotted.places))});
  return found;
}

}  // namespace

std::vector<Pick> picks_of_settings(const Swept& swept) {
  return picks(swept, run_time_against_whole_error(swept));
}
std::vector<Pick> picks_of_formats(const Swept& swept) {
  return picks(swept, bits_against_arithmetic_error(swept));
}

std::vector<const Measured*> faster_and_better(const Swept& swept) {
  constexpr std::size_t kMost = 3;
  const Measured& usual = swept.points.front();
  std::vector<const Measured*> found;
  for (const Measured& point : swept.points)
    if (point.cost.run_seconds && point.whole && *point.cost.run_seconds <= *usual.cost.run_seconds &&
        point.whole->largest() < usual.whole->largest())
      found.push_back(&point);
  std::stable_sort(found.begin(), found.end(), [](const Measured* a, const Measured* b) {
    return *a->cost.run_seconds < *b->cost.run_seconds;
  });
  found.resize(std::min(found.size(), kMost));
  return found;
}

}  // namespace voxmelt::accuracy::front
