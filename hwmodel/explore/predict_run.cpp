#include "hwmodel/explore/predict_run.h"

#include <cstddef>
#include <vector>

#include "hwmodel/explore/content.h"
#include "hwmodel/explore/dram_time.h"
#include "hwmodel/explore/schedule.h"
#include "hwmodel/pipeline/check/falling.h"

namespace voxmelt::hwmodel::explore {

void predict_on_memory(VerifyReport& report, const Design& design, const Configuration& configuration,
                       const memory::Choice& memory, const state::Volume& start,
                       const Irradiance* irradiance) {
  report.most_bytes_per_cycle = memory.most_bytes_per_cycle();
  const Design uncut{design.parameters, {start.grid, configuration.lanes}, 1, design.registers};
  Content content = content_of(uncut, irradiance, &start);
  content.falls = cells_that_fall(design.parameters, report.first_step, start).has_value();
  content.substeps = report.substeps;
  const std::vector<Train> trains =
      trains_of(design, configuration, report.first_step, report.steps, content);
  if (trains.size() != report.trains.size()) return;
  for (std::size_t i = 0; i < trains.size(); ++i)
    report.trains[i].predicted_on_memory =
        cycles_on(trains[i].work, *memory.dram, memory.clock_mhz, trains[i].placement);
}

}  // namespace voxmelt::hwmodel::explore
