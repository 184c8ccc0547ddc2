#include "hwmodel/pipeline/time/prediction.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

#include "hwmodel/pipeline/model/lag.h"

namespace voxmelt::hwmodel {
namespace {

struct Flow {
  std::int64_t interval, waits, channels;
  std::int64_t longest = 0;  // greatest lag of a stage, in tokens
};
Flow flow_of(const Design& design, const Configuration& configuration, const Pass& pass) {
  const std::vector<StageKind> stages = stages_of_step(design);
  Flow flow{configuration.interval(), 0, 0};
  const std::int64_t interval = flow.interval, tokens = design.shape.tokens();
  int copy = -1;
  for (const StageKind stage : stages) {
    if (stage == StageKind::settle) ++copy;
    if (!pass.uses(stage, copy)) continue;
    const std::int64_t lag = lag_of(stage, design).tokens(design.shape) + registers_of(stage, design);
    flow.longest = std::max(flow.longest, lag);
    flow.waits += pass.steps * (lag < tokens ? interval * lag : interval * (tokens - 1) + lag - tokens + 1);
  }
  flow.channels = configuration.cascade * std::ssize(stages) + 1;
  return flow;
}

// Returns the fewest tokens from the one with which a cell was read to the one with which it is read in the
// next pass. The first reading is the owner's, because the owner writes the cell.
std::int64_t shortest_return(const Shape& shape) {
  const std::int64_t tiles = shape.tiles();
  std::int64_t shortest = tiles * shape.tokens();
  for (int k = 0; k < tiles; ++k) {
    const int first = shape.first_block(k), owner = shape.owner(first + shape.blocks() - 1);
    shortest = std::min(
        shortest, (tiles + k - owner) * shape.tokens() + (shape.first_block(owner) - first) * shape.column());
  }
  return shortest;
}

// Returns the tokens for which the reader waits behind the one that it reads. With hw.coded, they are the
// rest of the column.
std::int64_t held_back(const Design& design, const Configuration& configuration) {
  return configuration.coded ? design.shape.column() - 1 : 0;
}

}  // namespace

std::int64_t predicted_cycles(const Design& design, const Configuration& configuration, const Pass& first,
                              std::int64_t streams) {
  const Flow flow = flow_of(design, configuration, first);
  return flow.interval * (streams * design.shape.tokens() - 1) + flow.waits + flow.channels + 1;
}

bool passes_overlap(const Design& design, const Configuration& configuration, const Pass& pass) {
  const Flow flow = flow_of(design, configuration, pass);
  return configuration.overlap && pass.begins() && pass.ends() && tiles_follow(design, configuration, pass) &&
         flow.interval * (shortest_return(design.shape) - held_back(design, configuration)) >
             flow.waits + flow.channels;
}

bool tiles_follow(const Design& design, const Configuration& configuration, const Pass& pass) {
  return configuration.overlap && flow_of(design, configuration, pass).longest < design.shape.tokens();
}

std::int64_t predicted_passes(const Design& design, const Configuration& configuration, const Pass& pass,
                              std::int64_t passes) {
  const std::int64_t tiles = design.shape.tiles();
  if (passes_overlap(design, configuration, pass))
    return predicted_cycles(design, configuration, pass, passes * tiles);
  if (tiles_follow(design, configuration, pass))
    return passes * predicted_cycles(design, configuration, pass, tiles);
  return passes * tiles * predicted_cycles(design, configuration, pass);
}

}  // namespace voxmelt::hwmodel
