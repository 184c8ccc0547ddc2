#include "hwmodel/explore/held.h"

#include <iterator>

#include "hwmodel/pipeline/check/falling.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "kernel/run/simulation.h"

namespace voxmelt::hwmodel::explore {

Held::Held(const TimedRun& run, const Design& design, const state::Volume& start,
           const step::Implementation& software, const std::function<void()>& poll) {
  const rule::Heat& heat = run.parameters.heat;
  const bool coded = run.configuration.coded;
  if (!heat.radiates() && !coded && !host_sees_each_step(run.parameters)) return;
  run::Simulation simulation(run.parameters, start, software);
  simulation.begin_at(run.first_step);
  for (std::int64_t step = 0; step < run.steps; ++step) {
    const std::uint32_t number = simulation.step_number();
    if (const auto cells = cells_that_fall(run.parameters, number, simulation.volume()))
      falls_.emplace(number, FallStream(*cells, design.shape));
    simulation.begin_step();
    substeps_.push_back(simulation.substeps());
    if (heat.radiates() && (irradiance_.empty() || heat.is_visibility_step(number)))
      irradiance_.emplace(number, IrradianceStream(*simulation.irradiance(), design.shape));
    if (coded) stored_.emplace(number, stored_tokens(design, simulation.volume()));
    for (const step::Phase phase : simulation.phases()) simulation.run_phase(phase);
    simulation.end_step();
    if (poll) poll();
  }
  if (coded) stored_.emplace(simulation.step_number(), stored_tokens(design, simulation.volume()));
}

void Held::give_to(TimedRun& run) const {
  if (!irradiance_.empty())
    run.irradiance = [this](std::uint32_t step) { return &std::prev(irradiance_.upper_bound(step))->second; };
  if (!falls_.empty())
    run.falls = [this](std::uint32_t step) {
      const auto at = falls_.find(step);
      return at == falls_.end() ? nullptr : &at->second;
    };
  run.substeps = substeps_;
  if (!stored_.empty()) run.stored = [this](std::uint32_t step) { return &stored_.at(step); };
}

}  // namespace voxmelt::hwmodel::explore
