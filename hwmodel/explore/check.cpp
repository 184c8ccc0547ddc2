#include "hwmodel/explore/check.h"

#include <optional>

#include "hwmodel/explore/dram_time.h"
#include "hwmodel/explore/operation_energy.h"
#include "hwmodel/explore/timing.h"
#include "hwmodel/memory/energy.h"
#include "hwmodel/memory/ratio.h"
#include "hwmodel/pipeline/check/falling.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/pipeline/streams/memory_streams.h"

namespace voxmelt::hwmodel::explore {

namespace {

// Returns the cycles of the run while the memory always answers. All steps are taken to be like the first.
std::int64_t cycles_without_waits(const Question& question, const Configuration& hw, std::uint32_t steps,
                                  const CheckInput& input) {
  TimedRun run{question.parameters, question.grid, hw, question.first_step, steps, input.poll, {}, {}, {},
               {question.substeps}};
  std::optional<FallStream> falls;
  if (const auto cells = cells_that_fall(question.parameters, question.first_step, input.start))
    falls.emplace(*cells, design_of(question.parameters, question.grid, hw).shape);
  if (falls) run.falls = [&](std::uint32_t) { return &*falls; };
  return timing_of(run, nullptr).cycles;
}

}  // namespace

double Checked::error() const { return ratio(predicted_on - on_memory, on_memory); }

Checked check(const Question& question, const Swept& swept, std::size_t at, std::uint32_t steps,
              const CheckInput& input) {
  const Point& point = swept.points[at];
  const PartList& parts = swept.parts[point.parts];
  Checked checked;
  checked.point = at;
  checked.steps = steps == 0 ? point.hw.cascade : steps;
  const RunTime time = time_of(parts, point.hw, point.clock_mhz, question, checked.steps);
  checked.predicted = time.cycles;
  checked.predicted_on = time.on_memory;
  checked.predicted_energy = time.energy;

  VerifyOptions options;
  options.steps = checked.steps;
  options.configuration = point.hw;
  options.poll = input.poll;
  std::optional<MemoryStreams> streams;
  if (question.memory)
    streams.emplace(design_of(question.parameters, question.grid, point.hw), point.hw.cascade,
                    *question.memory, point.clock_mhz);
  options.memory = streams ? &*streams : nullptr;
  const VerifyReport report =
      verify(question.parameters, input.start, question.first_step, input.fast, input.tuning, options);
  checked.good = report.mismatch == nullptr;
  if (!checked.good) checked.difference = text_of(*report.mismatch);
  checked.compared_cells = report.compared_cells;
  checked.digest = report.digest;
  checked.on_memory = report.cycles;
  checked.cycles =
      question.memory ? cycles_without_waits(question, point.hw, checked.steps, input) : report.cycles;
  checked.energy.operations = energy_of_run(report, point.hw.lanes, question.device.family).all();
  if (streams)
    checked.energy.memory = 1000 * memory::energy_of(streams->all_counts(), *question.memory).all();
  if (question.memory) checked.allowed = allowed_error(checked.on_memory, *question.memory, point.clock_mhz);
  checked.speed = speed_of(question, {checked.cycles, checked.on_memory, time.steps}, point.clock_mhz);
  checked.predicted_speed = speed_of(question, time, point.clock_mhz);
  return checked;
}

}  // namespace voxmelt::hwmodel::explore
