// Which passes a run is cut into, and what each train of them takes without stalls: the closed form of
// hwmodel/pipeline/time/prediction.h for a whole run.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/explore/content.h"
#include "hwmodel/explore/dram_time.h"
#include "hwmodel/pipeline/model/pipeline.h"
#include "hwmodel/pipeline/time/stream_work.h"

namespace voxmelt::hwmodel::explore {

struct Train {
  std::int64_t passes = 0, steps = 0;
  std::vector<Pass> list;  // the passes, tile by tile
  StreamWork work;         // as of one pass: the tokens of all passes, one after another
  Placement placement{};   // of the state on a DRAM
  std::int64_t times = 1;  // so many of them
};

// Every pass is taken to move what `content` says. Of a scene that counts its sub-steps from the state, every
// step is taken to have as many as the machine has copies.
std::vector<Train> trains_of(const Design& design, const Configuration& configuration,
                             std::uint32_t first_step, std::int64_t steps, const Content& content = {});
// The same, but trains that take the same time are one.
std::vector<Train> kinds_of_trains(const Design& design, const Configuration& configuration,
                                   std::uint32_t first_step, std::int64_t steps, const Content& content = {});

}  // namespace voxmelt::hwmodel::explore
