// A sweep answers with the front, the best design, what bounds it, and what the next unit of each resource
// would buy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "hwmodel/explore/sweep.h"

namespace voxmelt::hwmodel::explore {

// There is one front for each resource, one for the clock, and a last one for the energy.
inline constexpr std::size_t kClockFront = kResources, kEnergyFront = kResources + 1,
                             kFronts = kResources + 2;
std::string_view front_name(std::size_t front);  // "lut", ..., "clock", "energy"
std::int64_t amount_of(const Point& point, std::size_t front);

// Describes the cheapest step to a faster design by one resource alone.
struct Next {
  std::optional<std::size_t> point;  // none if no amount of it makes a design faster
  std::int64_t more = 0;             // additional units
  std::int64_t limit = 0;            // speed with any amount of it
};

struct Answer {
  std::optional<std::size_t> best;                       // none if nothing fits
  std::optional<std::size_t> frugal;                     // the most cell-steps per joule of those that fit
  std::array<std::vector<std::size_t>, kFronts> fronts;  // speed against each, slowest first
  std::vector<std::size_t> front;                        // all of these together, fastest first
  std::array<Next, kResources> next;
  std::int64_t with_twice_the_memory = 0, with_any_memory = 0;  // best speeds
  std::int64_t with_next_clock = 0;
  int next_clock_mhz = 0;
};

std::optional<std::size_t> best_point(const Swept& swept);  // of those that fit

Answer answer_of(const Question& question, const Axes& axes, const Swept& swept);

// Says if `a` is to be preferred. The faster one is, of equals the one that fills the device less, and then
// the one with the lower clock.
bool preferred(const Point& a, const Point& b);

}  // namespace voxmelt::hwmodel::explore
