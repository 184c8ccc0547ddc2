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

bool usual_is_on_the_front(const Swept& swept) {
  const Plotted plotted = run_time_against_whole_error(swept);
  const std::vector<std::size_t> left = undominated(plotted.places);
  return std::any_of(left.begin(), left.end(), [&](std::size_t i) {
    return swept.points[plotted.point[i]].choice.axis == Axis::usual;
  });
}

}  // namespace voxmelt::accuracy::front
