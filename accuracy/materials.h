#pragma once

#include "accuracy/case.h"

namespace voxmelt::accuracy {

Outcome measure_two_layers(const Conditions&);
Outcome measure_body_of_materials(const Conditions&);

}  // namespace voxmelt::accuracy
