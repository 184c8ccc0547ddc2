// The functions here find the points that no other point beats, and the setting to take for a bound on the
// error.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "accuracy/front/sweep.h"

namespace voxmelt::accuracy::front {

struct Place {
  double cost = 0, error = 0;
};

// Returns the indices of the places that none dominates, by ascending cost. A place dominates another if it
// is at most as dear and at most as wrong, and less of one of them. Among equal places the first one stays.
std::vector<std::size_t> undominated(std::span<const Place> places);

// Returns the index of the cheapest place with an error of at most `bound`.
std::optional<std::size_t> cheapest_within(std::span<const Place> places, double bound);

// Returns the index of the place with the least error, and among equal ones the cheapest.
std::optional<std::size_t> best(std::span<const Place> places);

// Lists the points of a sweep in a picture, and where they lie.
struct Plotted {
  std::vector<std::size_t> point;  // index in Swept::points
  std::vector<Place> places;
};
Plotted run_time_against_whole_error(const Swept& swept);   // the engine's runs, all on one grid
Plotted run_time_against_grid_error(const Swept& swept);    // the engine's runs on different grids
Plotted bits_against_arithmetic_error(const Swept& swept);  // the formats, with the engine's among them

}  // namespace voxmelt::accuracy::front
