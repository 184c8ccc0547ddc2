#pragma once

#include "accuracy/case.h"

namespace voxmelt::accuracy {

Outcome measure_books(const Conditions&);
Outcome measure_implementations(const Conditions&);
Outcome measure_limit(const Conditions&);

}  // namespace voxmelt::accuracy
