// The functions here say which setting to take for a bound on the error.
#pragma once

#include <span>

#include "accuracy/front/sweep.h"

namespace voxmelt::accuracy::front {

inline constexpr double kBounds[] = {0.05, 0.01, 0.001};

inline constexpr double kLeastSaving = 0.03;  // of the usual setting's time: less is not worth an error

// Returns the cheapest point along the axis whose error keeps the bound, or null. That is the coarsest one,
// but under the viscous law's keys the fastest, and there the usual setting stays if no other one saves
// enough. The map counts unless its noise exceeds the bound. If that of the curves does, no point is judged.
// A reference is the last choice, and only if nothing finer can be had.
const Measured* cheapest_within(std::span<const Measured> points, Axis axis, const Setting& usual,
                                const Noise& noise, double bound);

// Picks along each axis that has points. The time of the pick is not known yet.
Pick pick(std::span<const Measured> points, const Setting& usual, const Noise& noise, double bound);

}  // namespace voxmelt::accuracy::front
