#include "measure/baseline_run.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "kernel/engine/cpu/instruction_set.h"
#include "kernel/engine/visibility/visibility.h"
#include "measure/baseline/numbers.h"
#include "measure/native_needs.h"

namespace voxmelt::measure {
namespace {

template <class Task>
void timed(Seconds& step, step::Phase phase, const Task& task) {
  const auto start = std::chrono::steady_clock::now();
  task();
  step.phase[index_of(phase)] =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

std::optional<BaselineRuns> BaselineRuns::of(const Workload& workload) {
  rule::Parameters parameters = workload.parameters;
  state::Volume start = workload.start;
  if (parameters.flow.law == rule::Law::viscous) {
    parameters.flow.law = rule::Law::paper;
    for (std::size_t offset = 0; offset < start.amount.layout().cells(); ++offset)
      start.energy[{offset}] = start.amount[{offset}];
    const state::Grid g = start.grid;  // only liquid has energy
    for (int z = 0; z < g.z; ++z)
      for (int y = 0; y < g.y; ++y)
        for (int x = 0; x < g.x; ++x)
          if (!start.liquid.test(x, y, z)) start.energy[start.at(x, y, z)] = 0;
  }
  try {
    baseline::numbers_of<float>(parameters);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
  return BaselineRuns(workload, std::move(parameters), std::move(start));
}

BaselineRuns::BaselineRuns(const Workload& workload, rule::Parameters parameters, state::Volume start)
    : parameters_(std::move(parameters)),
      start_(std::move(start)),
      lead_steps_(workload.lead_steps),
      steps_(workload.steps),
      has_heat_(workload.times_heat) {
  if (!parameters_.heat.radiates()) return;
  state::Field<std::uint16_t> irradiance(start_.grid);
  visibility::VoxelWalkProvider().irradiance(start_, parameters_.heat, 0, irradiance);
  irradiance_ = baseline::irradiance_of<float>(start_.grid, irradiance);
}

template <baseline::Variant variant>
Steps BaselineRuns::run() const {
  using enum step::Phase;
  baseline::Baseline<float, variant> program(start_, parameters_);
  Steps steps(lead_steps_ + steps_);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (has_heat_) timed(steps[i], heat, [&] { program.heat(irradiance_); });
    timed(steps[i], gravity, [&] { program.gravity(); });
    timed(steps[i], spread, [&] { program.spread(static_cast<std::uint32_t>(i)); });
    timed(steps[i], excess, [&] { program.excess(); });
  }
  return {steps.begin() + lead_steps_, steps.end()};
}

Steps BaselineRuns::plain() const { return run<baseline::Variant::plain>(); }
std::optional<Steps> BaselineRuns::native() const {
  if (kNativeNeeds && !cpu::supported(*kNativeNeeds)) return std::nullopt;
  return run<baseline::Variant::native>();
}

}  // namespace voxmelt::measure
