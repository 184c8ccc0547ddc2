// The schedule cuts a run into trains of passes, and tells what each train takes without stalls. It is the
// closed form of hwmodel/pipeline/time/prediction.h for a whole run.
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
  StreamWork work;         // counted as one pass: the tokens of all passes, one after another
  Placement placement{};   // how the state lies on a DRAM
  std::int64_t times = 1;  // number of such trains
};

// Every pass is taken to move what `content` says.
std::vector<Train> trains_of(const Design& design, const Configuration& configuration,
                             std::uint32_t first_step, std::int64_t steps, const Content& content = {});
// Returns the same, but trains that take the same time are one.
std::vector<Train> kinds_of_trains(const Design& design, const Configuration& configuration,
                                   std::uint32_t first_step, std::int64_t steps, const Content& content = {});

}  // namespace voxmelt::hwmodel::explore
