#include "hwmodel/stream/prediction.h"

namespace voxmelt::hwmodel {

Lag lag_of_step(const Design& design) {
  const rule::Parameters& p = design.parameters;
  // Gravity waits for the cell above; where films hang, also for the one above that.
  const int above = p.flow.fall.hang > 0 ? 2 : 1;
  Lag lag;
  const auto stage = [&](int planes, int columns, int singles) {
    lag.planes += planes;
    lag.columns += columns;
    lag.singles += singles;
    ++lag.stages;
  };
  if (!p.vents.empty() || !p.drains.empty()) stage(0, 0, 0);  // source
  if (p.heat.enabled) {
    stage(1, 0, 0);                                      // conduction: the face towards +z
    if (p.heat.neighbours >= 18) stage(1, 1, 1);         // edges
    if (p.heat.neighbours >= 26) stage(1, 1, 1);         // corners
    if (p.heat.convection > 0) stage(0, 0, 1);           // the cell above
    if (p.heat.radiation || p.heat.air) stage(0, 0, 0);  // exchange
    stage(0, 0, 0);                                      // melt
  }
  if (design.paper()) {
    if (design.needs_walls()) stage(1, 0, 0);  // walls: the side towards +z
    stage(0, 0, above);                        // gravity
    stage(1, 1, 0);                            // pattern: the diagonal towards +x, +z
    stage(1, 1, 0);                            // apply
  } else {
    stage(0, 2, 1);      // settle: a column reversed twice, one token of look-ahead
    stage(1, 1, 0);      // spread
    stage(0, 0, above);  // gravity
  }
  return lag;
}

std::int64_t predicted_cycles(const Design& design, const Configuration& configuration, int steps) {
  const Lag lag = lag_of_step(design);
  const std::int64_t interval = configuration.fifo_depth == 1 ? 2 : 1;
  const std::int64_t channels = std::int64_t{configuration.cascade} * lag.stages + 1;
  return interval * (design.shape.tokens() - 1 + steps * lag.tokens(design.shape)) + channels + 1;
}

}  // namespace voxmelt::hwmodel
