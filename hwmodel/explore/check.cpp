#include "hwmodel/explore/check.h"

namespace voxmelt::hwmodel::explore {

double Checked::error() const {
  return on_memory == 0 ? 0 : static_cast<double>(predicted_on - on_memory) / static_cast<double>(on_memory);
}

std::int64_t simulated_on(const std::vector<Train>& trains, int clock_mhz, const Question& question) {
  raycast::Configuration memory;
  memory.clock_mhz = clock_mhz;
  memory.dram = question.memory;
  std::int64_t cycles = 0;
  for (const Train& train : trains)
    cycles += question.memory ? cycles_alone(train.work, memory) : train.work.cycles;
  return cycles;
}

Checked check(const Question& question, const Swept& swept, std::size_t at, std::uint32_t steps,
              const CheckInput& input) {
  const Point& point = swept.points[at];
  const Design& design = parts_of(swept, point.hw).design;
  Checked checked;
  checked.point = at;
  checked.steps = steps == 0 ? static_cast<std::uint32_t>(point.hw.cascade) : steps;
  const RunTime time = time_of(design, point.hw, point.clock_mhz, question, checked.steps);
  checked.predicted = time.cycles, checked.predicted_on = time.on_memory;

  VerifyOptions options;
  options.steps = checked.steps;
  options.configuration = point.hw;
  options.poll = input.poll;
  const VerifyReport report =
      verify(question.parameters, input.start, question.first_step, input.fast, input.tuning, options);
  checked.good = report.mismatch == nullptr;
  if (!checked.good) checked.difference = text_of(*report.mismatch);
  checked.compared_cells = report.compared_cells;
  checked.cycles = report.cycles;
  // The twin repeats the passes as they were simulated.
  std::vector<Train> trains = trains_of(design, point.hw, question.first_step, checked.steps);
  if (trains.size() == 1) trains.front().work.cycles = report.cycles;
  checked.on_memory = simulated_on(trains, point.clock_mhz, question);
  return checked;
}

}  // namespace voxmelt::hwmodel::explore
