#include <cstdint>
#include <vector>

#include "hwmodel/stream/prediction.h"

namespace voxmelt::hwmodel {

std::vector<Lag> lags_of_step(const Design& design) {
  const rule::Parameters& p = design.parameters;
  // Gravity waits for the cell above; where films hang, also for the one above that.
  const int above = p.flow.fall.hang > 0 ? 2 : 1;
  std::vector<Lag> lags;
  const auto stage = [&](int planes, int columns, int singles) {
    lags.push_back({planes, columns, singles});
  };
  if (!p.vents.empty() || !p.drains.empty()) stage(0, 0, 0);  // source
  if (p.heat.enabled) {
    stage(1, 0, 0);                                      // conduction: the face towards +z
    if (p.heat.neighbours >= 18) stage(1, 1, 0);         // edges: two axes at most
    if (p.heat.neighbours >= 26) stage(1, 1, 1);         // corners
    if (p.heat.convection > 0) stage(0, 0, 1);           // the cell above
    if (p.heat.radiation || p.heat.air) stage(0, 0, 0);  // exchange
    stage(0, 0, 0);                                      // melt
  }
  if (design.paper()) {
    if (design.needs_walls() && !p.heat.enabled) stage(1, 0, 0);  // walls: the side towards +z
    stage(0, 0, above);                                           // gravity
    stage(1, 1, 0);                                               // pattern: the diagonal towards +x, +z
    stage(1, 1, 0);                                               // apply
  } else {
    stage(0, 2, 1);      // settle: a column reversed twice, one token of look-ahead
    stage(1, 1, 0);      // spread
    stage(0, 0, above);  // gravity
  }
  return lags;
}

std::int64_t predicted_cycles(const Design& design, const Configuration& configuration, int steps) {
  const std::vector<Lag> lags = lags_of_step(design);
  const std::int64_t interval = configuration.fifo_depth == 1 ? 2 : 1, tokens = design.shape.tokens();
  std::int64_t waits = 0;
  for (const Lag& one : lags) {
    const std::int64_t lag = one.tokens(design.shape);
    waits += lag < tokens ? interval * lag : interval * (tokens - 1) + lag - tokens + 1;
  }
  const std::int64_t channels = configuration.cascade * static_cast<std::int64_t>(lags.size()) + 1;
  return interval * (tokens - 1) + steps * waits + channels + 1;
}

}  // namespace voxmelt::hwmodel
