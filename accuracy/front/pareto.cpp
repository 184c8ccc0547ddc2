#include "accuracy/front/pareto.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace voxmelt::accuracy::front {

namespace {

// Under the viscous law the reference is a run of the engine. Compared with itself it is no evidence.
bool is_its_own_reference(const Swept& swept, const Measured& point) {
  return swept.subject->viscous && point.choice.setting == swept.reference;
}

}  // namespace

std::vector<std::size_t> undominated(std::span<const Place> places) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(places[a].cost, places[a].error) < std::tie(places[b].cost, places[b].error);
  });
  std::vector<std::size_t> left;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order)
    if (places[i].error < least) {
      left.push_back(i);
      least = places[i].error;
    }
  return left;
}

std::optional<std::size_t> cheapest_within(std::span<const Place> places, double bound) {
  for (const std::size_t i : undominated(places))
    if (places[i].error <= bound) return i;
  return std::nullopt;
}

std::optional<std::size_t> best(std::span<const Place> places) {
  const std::vector<std::size_t> left = undominated(places);
  return left.empty() ? std::nullopt : std::optional(left.back());
}

Plotted run_time_against_whole_error(const Swept& swept) {
  Plotted plotted;
  for (std::size_t i = 0; i < swept.points.size(); ++i)
    if (const Measured& point = swept.points[i];
        point.cost.run_seconds && point.whole && !is_its_own_reference(swept, point)) {
      plotted.point.push_back(i);
      plotted.places.push_back({*point.cost.run_seconds, point.whole->largest()});
    }
  return plotted;
}

Plotted run_time_against_grid_error(const Swept& swept) {
  Plotted plotted;
  for (std::size_t i = 0; i < swept.points.size(); ++i)
    if (const Measured& point = swept.points[i]; point.cost.run_seconds && point.grid) {
      plotted.point.push_back(i);
      plotted.places.push_back({*point.cost.run_seconds, point.grid->largest()});
    }
  return plotted;
}

Plotted bits_against_arithmetic_error(const Swept& swept) {
  Plotted plotted;
  for (std::size_t i = 0; i < swept.points.size(); ++i)
    if (const Measured& point = swept.points[i]; point.twin) {
      plotted.point.push_back(i);
      plotted.places.push_back({1. * point.cost.state_bits, point.arithmetic->largest()});
    }
  return plotted;
}

}  // namespace voxmelt::accuracy::front
