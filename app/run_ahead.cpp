#include "app/run_ahead.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/interrupt.h"

namespace voxmelt::app {

run::Simulation run_ahead(scene::Scene& scene, const Common& common, std::uint32_t from,
                          std::uint32_t steps) {
  const std::uint64_t asked = std::uint64_t{scene.first_step} + from;
  if (asked + steps > 0xFFFFFFFFu)
    throw UsageError(fmt::format("error: --from {}: step numbers end at {}", from, 0xFFFFFFFFu));
  auto until = static_cast<std::uint32_t>(asked);
  until -= scene.parameters.heat.visibility_age(until);
  until = std::max(until, scene.first_step);
  if (!common.quiet && until != asked) fmt::print("verifying from step {}, a step of visibility\n", until);
  run::Simulation simulation = make_simulation(scene, common);
  while (simulation.step_number() < until) {
    simulation.step();
    stop_if_interrupted();
  }
  return simulation;
}

}  // namespace voxmelt::app
