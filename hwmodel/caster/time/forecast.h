// The cycles of a pass without a picture: queues through which rays go as often as was counted. No position,
// level or address is known here, and no number is fitted. What remains is the machine's structure: how many
// tokens a stage takes in a cycle, how many a queue holds, and what waits for the memory.
//
// If it agrees with the machine, then the counted steps, requests and misses explain its cycles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hwmodel/caster/model/configuration.h"
#include "hwmodel/caster/model/pass_counts.h"

namespace voxmelt::hwmodel::raycast {

struct ForecastInput {
  std::vector<PipeCounts> pipes;
  std::array<int, PipeCounts::kCaches> line_bytes{};
  bool second = false;
  int samples = 1;  // of a pixel
};
// Without stalls and with a memory of fixed latency; with others it is not known: -1.
std::int64_t forecast(const ForecastInput& input, const Configuration& configuration);

}  // namespace voxmelt::hwmodel::raycast
