// How many cycles a pass takes when nothing stalls, from the configuration alone.
#pragma once

#include "hwmodel/stream/pipeline.h"

namespace voxmelt::hwmodel {

// interval (N - 1 + steps L) + channels + 1: N tokens, each `interval` cycles after the one before it; a time
// step holds its tokens back by L of them; every channel holds them for one cycle.
std::int64_t predicted_cycles(const Design& design, const Configuration& configuration, int steps);

// L, in tokens: how many planes, columns and single tokens a time step must have seen before it can give its
// first cell.
struct Lag {
  int planes = 0, columns = 0, singles = 0;
  int stages = 0;
  std::int64_t tokens(const Shape& shape) const {
    return planes * shape.plane() + columns * shape.column() + singles;
  }
};
Lag lag_of_step(const Design& design);

}  // namespace voxmelt::hwmodel
