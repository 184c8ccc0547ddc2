#pragma once

#include "accuracy/case.h"

namespace voxmelt::accuracy {

Outcome measure_rest(const Conditions&);
Outcome measure_fall(const Conditions&);
Outcome measure_filling(const Conditions&);
Outcome measure_layers(const Conditions&);

}  // namespace voxmelt::accuracy
