#pragma once

#include "accuracy/case.h"

namespace voxmelt::accuracy {

Outcome measure_pieces(const Conditions&);

}  // namespace voxmelt::accuracy
