#pragma once

#include <cstdint>

#include "accuracy/case.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {

// Returns half the sum of all changes of amounts in the next `steps`, in cells.
double motion(Trial& trial, std::uint32_t steps);

Outcome measure_rest(const Conditions&);
Outcome measure_fall(const Conditions&);
Outcome measure_filling(const Conditions&);
Outcome measure_layers(const Conditions&);
Outcome measure_yield_heap(const Conditions&);

}  // namespace voxmelt::accuracy
